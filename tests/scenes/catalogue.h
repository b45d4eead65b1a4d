// SPDX-License-Identifier: Apache-2.0
// All artefacts' scenes by name, for programs that write or measure them.
#pragma once

#include <string>
#include <vector>

#include "tests/scenes/artefact_scene.h"

namespace surimi::test {

struct NamedArtefact {
    std::string name;
    ArtefactScene (*make)();
};

const std::vector<NamedArtefact>& all_artefacts();

/// Throws std::invalid_argument for names that are none.
ArtefactScene artefact_named(const std::string& name);

}  // namespace surimi::test
