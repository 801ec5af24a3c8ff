// The model that comes with Pluvia, beside the program.
#pragma once

#include <string>

namespace pluvia {

/// Where it is. Throws Error (input) when it is not there.
std::string default_model_path();

}  // namespace pluvia
