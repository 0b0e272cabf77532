// SPDX-License-Identifier: Apache-2.0
#include "interruption.h"

#include <csignal>

namespace tautline {
namespace {

volatile std::sig_atomic_t isNoted = 0;

void note(int signal) {
    isNoted = 1;
    std::signal(signal, SIG_DFL);
}

}  // namespace

Interruption::Interruption() {
    isNoted = 0;
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
}

Interruption::~Interruption() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool Interruption::isRequested() const {
    return isNoted != 0;
}

}  // namespace tautline
