// SPDX-License-Identifier: Apache-2.0
#include "cable_workspaces.h"

namespace tautline {

CableWorkspaces::Loan CableWorkspaces::lend() {
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        if (!m_idle.empty()) {
            std::unique_ptr<CableWorkspace> workspace = std::move(m_idle.back());
            m_idle.pop_back();
            return Loan(*this, std::move(workspace));
        }
    }
    return Loan(*this, std::make_unique<CableWorkspace>(m_options));
}

void CableWorkspaces::takeBack(std::unique_ptr<CableWorkspace> workspace) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_idle.push_back(std::move(workspace));
}

}  // namespace tautline
