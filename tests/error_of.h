// The error that something throws, to be looked at.
#pragma once

#include "renderer/core/error.h"

namespace pluvia {

/// Its code is ExitCode::ok where body throws none.
template <class Body>
Error error_of(Body body) {
    try {
        body();
    } catch (const Error& e) {
        return e;
    }
    return {ExitCode::ok, "", "no error"};
}

}  // namespace pluvia
