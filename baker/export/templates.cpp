// SPDX-License-Identifier: Apache-2.0
#include "baker/export/templates.h"

#include <array>
#include <cassert>

// One file of samples/ as bytes of the program. SURIMI_SAMPLES is that folder at build.
#define SURIMI_EMBED(symbol, name)                                                       \
    __asm__(".pushsection .rodata\n" #symbol                                             \
            "_begin:\n"                                                                  \
            ".incbin \"" SURIMI_SAMPLES "/" name "\"\n" #symbol "_end:\n.popsection\n"); \
    extern "C" const char symbol##_begin[];                                              \
    extern "C" const char symbol##_end[];

SURIMI_EMBED(surimi_unity_component, "unity/SurimiVisibility.cs")
SURIMI_EMBED(surimi_unity_setup, "unity/Editor/SurimiSetup.cs")
SURIMI_EMBED(surimi_unity_importer, "unity/Editor/SurimiTextureImporter.cs")
SURIMI_EMBED(surimi_kanikama, "unity/kanikama.md")
SURIMI_EMBED(surimi_ltcgi, "unity/ltcgi.md")
SURIMI_EMBED(surimi_arealit, "unity/arealit.md")
SURIMI_EMBED(surimi_godot_lights, "godot/surimi_lights.gdshaderinc")
SURIMI_EMBED(surimi_godot_shader, "godot/surimi.gdshader")
SURIMI_EMBED(surimi_godot_apply, "godot/surimi_apply.gd")
SURIMI_EMBED(surimi_godot_import, "godot/surimi_import.gd")
SURIMI_EMBED(surimi_godot, "godot/README.md")
SURIMI_EMBED(surimi_three_page, "web/three.html")
SURIMI_EMBED(surimi_three, "web/three.md")

namespace surimi {
namespace {

struct Template {
    std::string_view name;
    const char* begin;
    const char* end;
};

const std::array templates{
    Template{"unity/SurimiVisibility.cs", surimi_unity_component_begin, surimi_unity_component_end},
    Template{"unity/Editor/SurimiSetup.cs", surimi_unity_setup_begin, surimi_unity_setup_end},
    Template{"unity/Editor/SurimiTextureImporter.cs", surimi_unity_importer_begin, surimi_unity_importer_end},
    Template{"unity/kanikama.md", surimi_kanikama_begin, surimi_kanikama_end},
    Template{"unity/ltcgi.md", surimi_ltcgi_begin, surimi_ltcgi_end},
    Template{"unity/arealit.md", surimi_arealit_begin, surimi_arealit_end},
    Template{"godot/surimi_lights.gdshaderinc", surimi_godot_lights_begin, surimi_godot_lights_end},
    Template{"godot/surimi.gdshader", surimi_godot_shader_begin, surimi_godot_shader_end},
    Template{"godot/surimi_apply.gd", surimi_godot_apply_begin, surimi_godot_apply_end},
    Template{"godot/surimi_import.gd", surimi_godot_import_begin, surimi_godot_import_end},
    Template{"godot/README.md", surimi_godot_begin, surimi_godot_end},
    Template{"web/three.html", surimi_three_page_begin, surimi_three_page_end},
    Template{"web/three.md", surimi_three_begin, surimi_three_end},
};

}  // namespace

std::string_view template_text(std::string_view name) {
    for (const Template& one : templates)
        if (one.name == name) return {one.begin, static_cast<size_t>(one.end - one.begin)};
    assert(false && "no such template");
    return {};
}

std::string fill_in(std::string_view text, const std::vector<std::pair<std::string, std::string>>& values) {
    constexpr std::string_view open = "{{", close = "}}";
    std::string result;
    for (size_t at = 0; at < text.size();) {
        const size_t begin = text.find(open, at);
        const size_t end = begin == std::string_view::npos ? begin : text.find(close, begin);
        result += text.substr(at, begin - at);
        if (end == std::string_view::npos) break;
        const std::string_view key = text.substr(begin + open.size(), end - begin - open.size());
        bool is_known = false;
        for (const auto& [name, value] : values)
            if (name == key) result += value, is_known = true;
        assert(is_known);
        (void)is_known;
        at = end + close.size();
    }
    return result;
}

std::string markdown_text(const std::string& text) {
    constexpr std::string_view marks = "\\`*_{}[]()<>#+-.!|&~$";
    std::string result;
    for (const char c : text) {
        if (marks.find(c) != std::string_view::npos) result += '\\';
        result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return result;
}

}  // namespace surimi
