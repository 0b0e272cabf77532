// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tautline {

/** While it lives, Ctrl-C and a request to terminate are only noted, so that a run may end with what it has. The second
one ends the program at once. One at a time. */
class Interruption {
public:
    Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;
    ~Interruption();

    bool isRequested() const;
};

}  // namespace tautline
