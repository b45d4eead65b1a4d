// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/error.h"
#include "runtime/batch/batch.h"

#include <hwy/highway.h>

#include <algorithm>

namespace surimi {
namespace {

/// What the processor and the build have, best first; asked once, before any choice hides some.
const std::vector<int64_t>& targets() {
    static const std::vector<int64_t> all = hwy::SupportedAndGeneratedTargets();
    return all;
}

}  // namespace

std::vector<std::string> instruction_sets() {
    std::vector<std::string> names;
    for (const int64_t target : targets()) names.emplace_back(hwy::TargetName(target));
    return names;
}

void use_instruction_set(const std::string& name) {
    const auto found = std::ranges::find_if(targets(), [&](int64_t target) { return name == hwy::TargetName(target); });
    if (!name.empty() && found == targets().end())
        throw Error(ErrorKind::usage, "instruction set " + name + " is not one of this processor and build");
    hwy::SetSupportedTargetsForTest(name.empty() ? 0 : *found);
    hwy::GetChosenTarget().DeInit();  // the next call looks again
}

}  // namespace surimi
