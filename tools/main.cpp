#include "tools/commands.h"

int main(int argc, char** argv) {
    return pluvia::run(argc, argv);
}
