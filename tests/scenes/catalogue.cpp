// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/catalogue.h"

#include <stdexcept>

#include "tests/scenes/scales.h"
#include "tests/scenes/screens.h"
#include "tests/scenes/seams.h"
#include "tests/scenes/smooth.h"
#include "tests/scenes/texels.h"
#include "tests/scenes/walls.h"

namespace surimi::test {

const std::vector<NamedArtefact>& all_artefacts() {
    static const std::vector<NamedArtefact> all = {
        {"two_rooms", two_rooms},
        {"two_rooms_on_one_floor", two_rooms_on_one_floor},
        {"closed_room", [] { return closed_room(0); }},
        {"closed_room_of_thick_walls", [] { return closed_room(0.2); }},
        {"box_sunk_into_a_floor", box_sunk_into_a_floor},
        {"box_upon_a_floor", box_upon_a_floor},
        {"boxes_that_interpenetrate", boxes_that_interpenetrate},
        {"boxes_in_a_row", boxes_in_a_row},
        {"rug_in_the_plane_of_a_floor", rug_in_the_plane_of_a_floor},
        {"poster_behind_a_wall", poster_behind_a_wall},
        {"poster_before_a_wall", poster_before_a_wall},
        {"plane_of_one_quad", [] { return ArtefactScene(cut_plane(Cut::nowhere)); }},
        {"plane_of_two_charts", [] { return ArtefactScene(cut_plane(Cut::charts)); }},
        {"plane_of_two_surfaces", [] { return ArtefactScene(cut_plane(Cut::surfaces)); }},
        {"plane_on_two_pages", [] { return ArtefactScene(cut_plane(Cut::pages)); }},
        {"box_with_hard_edges", box_with_hard_edges},
        {"smooth_cylinder_8", [] { return smooth_cylinder(8); }},
        {"smooth_cylinder_16", [] { return smooth_cylinder(16); }},
        {"smooth_cylinder_64", [] { return smooth_cylinder(64); }},
        {"smooth_ball", [] { return smooth_ball(1); }},
        {"pipe_through_a_wall", pipe_through_a_wall},
        {"cylinder_against_a_wall", cylinder_against_a_wall},
        {"screen_in_a_walls_plane", [] { return screen_on_a_wall(0); }},
        {"screen_before_a_wall", [] { return screen_on_a_wall(1e-4); }},
        {"screen_behind_a_walls_face", [] { return screen_on_a_wall(-1e-3); }},
        {"screen_behind_mesh", [] { return screen_behind(Cover::mesh); }},
        {"screen_behind_glass", [] { return screen_behind(Cover::glass); }},
        {"screen_on_the_floor", screen_on_the_floor},
        {"cards_lit_from_behind", cards_lit_from_behind},
        {"card_lit_from_behind", card_lit_from_behind},
        {"sliver_charts", sliver_charts},
        {"texels_with_two_shadows", texels_with_two_shadows},
        {"texels_with_two_normals", texels_with_two_normals},
        {"texel_at_the_origin", texel_at_the_origin},
        {"black_beside_unlit", black_beside_unlit},
        {"furnished_room", furnished_room}};
    return all;
}

ArtefactScene artefact_named(const std::string& name) {
    for (const NamedArtefact& artefact : all_artefacts())
        if (artefact.name == name) return artefact.make();
    throw std::invalid_argument("no such scene: " + name);
}

}  // namespace surimi::test
