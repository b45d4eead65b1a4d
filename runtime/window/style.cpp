// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/style.h"

#include <imgui.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

namespace surimi {
namespace {

constexpr float font_points = 15;

/// A sans-serif font in the folders that the desktop's base directories name (XDG); empty: none of them.
std::filesystem::path find_font() {
    const char* variable = std::getenv("XDG_DATA_DIRS");
    const bool is_set = variable != nullptr && *variable != 0;
    std::istringstream folders(is_set ? variable : "/usr/local/share:/usr/share");  // the standard's own default
    for (std::string folder; std::getline(folders, folder, ':');)
        for (const char* name : {"noto/NotoSans-Regular.ttf", "dejavu/DejaVuSans.ttf",
                                 "liberation/LiberationSans-Regular.ttf", "freefont/FreeSans.ttf"}) {
            const std::filesystem::path path = std::filesystem::path(folder) / "fonts/truetype" / name;
            std::error_code ignored;
            if (std::filesystem::exists(path, ignored)) return path;
        }
    return {};
}

void set_colors(ImVec4* colors) {
    const ImVec4 ground{0.09f, 0.10f, 0.12f, 1}, field{0.16f, 0.18f, 0.21f, 1}, raised{0.22f, 0.25f, 0.29f, 1},
        accent{0.98f, 0.60f, 0.36f, 1}, strong{0.85f, 0.42f, 0.22f, 1}, text{0.90f, 0.91f, 0.92f, 1};
    colors[ImGuiCol_Text] = text;
    colors[ImGuiCol_WindowBg] = ground;
    colors[ImGuiCol_PopupBg] = {0.12f, 0.13f, 0.15f, 0.98f};
    colors[ImGuiCol_Border] = {1, 1, 1, 0.08f};
    colors[ImGuiCol_Separator] = {1, 1, 1, 0.12f};
    for (const int c : {ImGuiCol_FrameBg, ImGuiCol_Button, ImGuiCol_Header, ImGuiCol_ScrollbarGrab}) colors[c] = field;
    for (const int c : {ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive, ImGuiCol_ButtonHovered, ImGuiCol_HeaderHovered,
                        ImGuiCol_ScrollbarGrabHovered})
        colors[c] = raised;
    colors[ImGuiCol_CheckMark] = accent;
    colors[ImGuiCol_SliderGrab] = {accent.x, accent.y, accent.z, 0.55f};  // numbers are read through it
    for (const int c : {ImGuiCol_SliderGrabActive, ImGuiCol_ButtonActive, ImGuiCol_HeaderActive, ImGuiCol_PlotHistogram,
                        ImGuiCol_TextSelectedBg})
        colors[c] = strong;
    colors[ImGuiCol_ScrollbarBg] = ground;
}

}  // namespace

void set_style(float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    ImGui::StyleColorsDark(&style);
    set_colors(style.Colors);
    style.WindowPadding = {12, 10};
    style.FramePadding = {8, 3};
    style.ItemSpacing = {8, 6};
    style.WindowRounding = 0;
    style.FrameRounding = style.GrabRounding = style.PopupRounding = 4;
    style.WindowBorderSize = 0;
    style.ScaleAllSizes(scale);
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    const std::filesystem::path font = find_font();
    if (!font.empty()) fonts.AddFontFromFileTTF(font.c_str(), font_points * scale);
    if (fonts.Fonts.empty()) {
        ImFontConfig own;
        own.SizePixels = 13 * scale;  // the size that its pixels are drawn for
        fonts.AddFontDefault(&own);
    }
}

}  // namespace surimi
