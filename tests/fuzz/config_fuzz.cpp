// libFuzzer target of the YAML files that users write, dataset configurations and label rules: whatever the bytes, what
// they say or a refusal with exit code 2 or 3, nothing else; and no rule hangs on a name.
//   CXX=clang++-14 cmake -S . -B build-fuzz -G Ninja -DPLUVIA_FUZZ=ON && cmake --build build-fuzz --target config_fuzz
//   build-fuzz/tests/fuzz/config_fuzz -dict=tests/fuzz/config.dict -max_len=1024 -runs=1000000 FOLDER tests/fuzz/config
#include "renderer/core/error.h"
#include "tests/fuzz/memory_file.h"
#include "tools/dataset/config.h"
#include "tools/label_rules.h"

#include <cstdlib>
#include <iostream>

using namespace pluvia;

namespace {

template <class Read>
void expect_refusal_or_success(const Read& read) {
    try {
        read();
    } catch (const Error& e) {
        if (e.code() == ExitCode::input || e.code() == ExitCode::usage) return;
        std::cerr << "neither exit code 2 nor 3: " << e.what() << "\n";
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    static const MemoryFile file("dataset.yaml");
    file.write(bytes, size);
    // Rules are a list and a dataset is a map: to read each file as both would take twice the time to find little more.
    if (size > 0 && (bytes[0] == '-' || bytes[0] == '['))
        expect_refusal_or_success([] {
            for (const LabelRule& rule : read_label_rules(file.path))
                std::regex_match("street/car_taxi_aaaaaaaaaaaaaaaaaaaa!", rule.path);
        });
    else
        expect_refusal_or_success([] { read_dataset_config(file.path); });
    return 0;
}
