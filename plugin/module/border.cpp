// SPDX-License-Identifier: Apache-2.0
#include "border.h"

#include <SimTKcommon.h>

#include <cstdio>

#include "tautline/error.h"
#include "tautline/models/model_error.h"

namespace tautline::plugin {

void requirePointer(const void* pointer, const char* name) {
    if (!pointer) throw BorderError(TAUTLINE_BAD_ARGUMENT, std::string(name) + " is NULL");
}

void report(tautline_error* error, int line, const char* message) noexcept {
    if (!error) return;
    error->line = line;
    std::snprintf(error->message, sizeof error->message, "%s", message);
}

tautline_result reportException(tautline_error* error) noexcept {
    const auto tell = [error](tautline_result result, const std::exception& what, int line = 0) {
        report(error, line, what.what());
        return result;
    };
    try {
        throw;
    } catch (const BorderError& known) {
        return tell(known.getResult(), known);
    } catch (const models::ModelError& known) {
        return tell(known.getLine() > 0 ? TAUTLINE_BAD_DESCRIPTION : TAUTLINE_BAD_ARGUMENT, known, known.getLine());
    } catch (const InvalidInput& known) {
        return tell(TAUTLINE_BAD_ARGUMENT, known);
    } catch (const SimTK::Exception::StageTooLow& known) {
        return tell(TAUTLINE_WRONG_STAGE, known);
    } catch (const std::exception& known) {
        return tell(TAUTLINE_FAILED, known);
    } catch (...) {
        report(error, 0, "an exception of unknown type");
        return TAUTLINE_FAILED;
    }
}

}  // namespace tautline::plugin
