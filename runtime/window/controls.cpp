// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/controls.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/base/color.h"
#include "runtime/preview/see.h"

namespace surimi {
namespace {

template <class T>
struct Choice {
    T value;
    const char* name;
    const char* help;
};

constexpr std::array<Choice<Show>, 10> shows = {{
    {Show::lit, "lit", "What the eye sees"},
    {Show::diffuse, "diffuse", "Reflected by the matte part alone"},
    {Show::specular, "specular", "The highlights alone"},
    {Show::visibility, "visibility", "The map: red, green and blue are the share of each monitor that is seen"},
    {Show::unshadowed, "unshadowed", "Light of each monitor as if nothing stood in its way"},
    {Show::shadowed, "shadowed", "Light of each monitor that arrives"},
    {Show::uv, "uv", "Lightmap coordinates"},
    {Show::texels, "texels", "Lightmap texels on the surfaces, eight by eight in a colour"},
    {Show::normals, "normals", "With normal maps"},
    {Show::roughness, "roughness", "Black is a mirror, white is matte"},
}};

constexpr std::array<Choice<ShadingModel>, 4> models = {{
    {ShadingModel::exact, "exact", "Closed forms, cut at the horizons"},
    {ShadingModel::kanikama, "kanikama", "What Kanikama's shader shows"},
    {ShadingModel::three, "three", "What three.js' RectAreaLight shows"},
    {ShadingModel::reference, "reference", "Brute force: the truth, with noise"},
}};

constexpr std::array<Choice<VisibilitySource>, 3> sources = {{
    {VisibilitySource::none, "none", "Nothing is shadowed"},
    {VisibilitySource::baked, "baked", "The map"},
    {VisibilitySource::stochastic, "stochastic", "The ratio of a few rays: no map, some noise"},
}};

void explain(const char* text) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

void heading(const char* text) {
    ImGui::Dummy({0, 0.5f * ImGui::GetStyle().ItemSpacing.y});
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_CheckMark));
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
    ImGui::Separator();
}

/// A label in a column of its own; the next item takes the rest of the line.
void label(const char* text) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text);
    ImGui::SameLine(0.36f * ImGui::GetWindowContentRegionWidth());
    ImGui::SetNextItemWidth(-1);
}

template <class T, size_t n>
void choose(const char* text, const std::array<Choice<T>, n>& choices, T& value) {
    label(text);
    const auto found = std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.value == value; });
    if (ImGui::BeginCombo(fmt::format("##{}", text).c_str(), found != choices.end() ? found->name : "",
                          ImGuiComboFlags_HeightLarge)) {
        for (const Choice<T>& choice : choices) {
            if (ImGui::Selectable(choice.name, choice.value == value)) value = choice.value;
            explain(choice.help);
        }
        ImGui::EndCombo();
    } else if (found != choices.end()) {
        explain(found->help);
    }
}

void draw_lamp(Lamp& lamp, size_t number) {
    ImGui::PushID(static_cast<int>(number));
    ImGui::Checkbox(lamp.name.c_str(), &lamp.is_on);
    explain(fmt::format("Switch it off or on (key {})", number + 1).c_str());
    const double largest = largest_component(lamp.radiance);
    std::array<float, 3> code{};
    for (int c = 0; c < 3; ++c)
        code[static_cast<size_t>(c)] = static_cast<float>(srgb_from_linear(lamp.radiance[c] / largest));
    if (ImGui::ColorEdit3("##colour", code.data(),
                          ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_NoTooltip |
                              ImGuiColorEditFlags_PickerHueWheel)) {
        const auto linear = [&](size_t c) { return linear_from_srgb(static_cast<double>(code[c])); };
        lamp.radiance = recolored(lamp.radiance, {linear(0), linear(1), linear(2)});
        lamp.is_on = true;
    }
    explain("Colour; its brightness is the slider");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    auto nits = static_cast<float>(largest);
    if (ImGui::SliderFloat("##nits", &nits, 0.01f, 10000, nits < 10 ? "%.2f nits" : "%.0f nits",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat) &&
        nits > 0 && std::isfinite(nits)) {
        lamp.radiance *= static_cast<double>(nits) / largest;
        lamp.is_on = true;
    }
    explain("Radiance of the brightest colour channel. Ctrl-click to type a number");
    ImGui::PopID();
}

/// Shadows and shading, with brute force as one of the sources, as on the command line.
void draw_light(bool has_map, LightingSettings& lighting) {
    const bool is_reference = lighting.model == ShadingModel::reference;
    label("shadows");
    const auto source =
        std::find_if(sources.begin(), sources.end(), [&](const auto& c) { return c.value == lighting.visibility; });
    const bool is_all_truth = is_reference && lighting.visibility != VisibilitySource::none;
    if (ImGui::BeginCombo("##shadows", is_all_truth ? "reference" : source->name)) {
        for (const auto& choice : sources) {
            if (choice.value == VisibilitySource::baked && !has_map) continue;
            if (ImGui::Selectable(choice.name, !is_all_truth && choice.value == lighting.visibility)) {
                lighting.visibility = choice.value;
                if (is_reference && choice.value != VisibilitySource::none) lighting.model = ShadingModel::exact;
            }
            explain(choice.help);
        }
        if (ImGui::Selectable("reference", is_all_truth)) {
            lighting.model = ShadingModel::reference;
            if (lighting.visibility == VisibilitySource::none) lighting.visibility = VisibilitySource::baked;
        }
        explain("All of the light by brute force");
        ImGui::EndCombo();
    } else {
        explain("Where shadows come from (key V)");
    }
    choose("shading", models, lighting.model);
    if (lighting.model == ShadingModel::reference || lighting.visibility == VisibilitySource::stochastic) {
        label("light rays");
        ImGui::SliderInt("##rays", &lighting.samples, 1, 256, "%d", ImGuiSliderFlags_Logarithmic);
        explain("For each sample of a pixel and each monitor, of both techniques");
        lighting.samples = std::clamp(lighting.samples, 1, 65536);
    }
    label("roughness");
    bool is_overridden = lighting.roughness.has_value();
    if (ImGui::Checkbox("##overridden", &is_overridden))
        lighting.roughness = is_overridden ? std::optional(0.3) : std::nullopt;
    explain("One roughness for every surface, in place of its own");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    auto roughness = static_cast<float>(lighting.roughness.value_or(0.3));
    if (ImGui::SliderFloat("##roughness", &roughness, 0, 1, is_overridden ? "%.2f" : "its own",
                           ImGuiSliderFlags_AlwaysClamp))
        lighting.roughness = static_cast<double>(roughness);
}

void draw_exposure(const RenderStatus& status, Choices& choices) {
    label("exposure");
    const float button = 3.6f * ImGui::GetFontSize();
    ImGui::SetNextItemWidth(-button - ImGui::GetStyle().ItemSpacing.x);
    auto stops = static_cast<float>(choices.exposure.value_or(std::log2(status.exposure)));
    if (ImGui::SliderFloat("##exposure", &stops, -16, 10, choices.exposure ? "%+.2f EV" : "%+.2f EV auto"))
        choices.exposure = static_cast<double>(stops);
    explain("Brightness of the picture, in stops; lit views only");
    ImGui::SameLine();
    if (ImGui::Button("meter", {-1, 0})) {
        choices.exposure.reset();
        ++choices.metering;
    }
    explain("Automatic exposure of what is in view now. It is kept while lights change, so that they show (key M)");
}

void draw_camera(const WindowSettings& settings, Choices& choices) {
    label("field of view");
    auto degrees = static_cast<float>(choices.view.yfov * 180 / pi);
    if (ImGui::SliderFloat("##fov", &degrees, 10, 120, "%.0f deg", ImGuiSliderFlags_AlwaysClamp))
        choices.view.yfov = static_cast<double>(degrees) * pi / 180;
    if (settings.views.empty()) return;
    label("go to");
    if (ImGui::BeginCombo("##views", "a camera")) {
        for (const NamedView& named : settings.views)
            if (ImGui::Selectable(named.name.c_str())) choices.view = named.view;
        ImGui::EndCombo();
    }
}

std::string state_of(const RenderStatus& status) {
    if (status.passes_wanted == 0) return "waiting for the first picture";
    if (status.is_done) return "finished";
    if (status.block > 1 || status.passes == 0) return "first pass";
    return fmt::format("pass {} of {}", status.passes + 1, status.passes_wanted);
}

/// 1234567 -> "1.2 M"
std::string counted(size_t count) {
    const auto n = static_cast<double>(count);
    if (n < 1e3) return fmt::format("{}", count);
    if (n < 1e6) return fmt::format("{:.0f} k", n / 1e3);
    return n < 1e9 ? fmt::format("{:.1f} M", n / 1e6) : fmt::format("{:.2f} G", n / 1e9);
}

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

void begin_area(const char* name, const Area& area, ImGuiWindowFlags flags) {
    ImGui::SetNextWindowPos({area.x, area.y});
    ImGui::SetNextWindowSize({area.width, area.height});
    ImGui::Begin(name, nullptr, flags);
}

}  // namespace

Requests draw_panel(const Area& area, const WindowSettings& settings, bool has_map, const RenderStatus& status,
                    Choices& choices) {
    Requests requests;
    begin_area("panel", area, fixed & ~ImGuiWindowFlags_NoScrollbar);
    ImGui::TextUnformatted(settings.title.c_str());
    if (!settings.note.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogram));
        ImGui::TextWrapped("%s", settings.note.c_str());
        ImGui::PopStyleColor();
    }
    heading("Monitors");
    for (size_t m = 0; m < choices.lamps.size(); ++m) draw_lamp(choices.lamps[m], m);
    if (choices.lamps.empty()) ImGui::TextWrapped("The scene has no monitor.");
    heading("Light");
    draw_light(has_map, choices.lighting);
    heading("Picture");
    choose("show", shows, choices.show);
    draw_exposure(status, choices);
    label("samples");
    ImGui::SliderInt("##samples", &choices.samples_per_side, 1, 16,
                     fmt::format("{} a pixel", choices.samples_per_side * choices.samples_per_side).c_str());
    choices.samples_per_side = std::clamp(choices.samples_per_side, 1, 64);
    explain("Passes until the picture is finished");
    heading("Camera");
    draw_camera(settings, choices);
    heading("Save");
    const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button("PNG", {half, 0})) requests.save_as = ".png";
    explain("The picture as it is shown (key P)");
    ImGui::SameLine();
    if (ImGui::Button("EXR", {-1, 0})) requests.save_as = ".exr";
    explain("Linear radiance in nits (key X)");
    if (ImGui::Button("Keys and mouse", {-1, 0})) requests.wants_help = true;
    explain("The list of them (key H)");
    ImGui::End();
    return requests;
}

void draw_status(const Area& area, const RenderStatus& status, Show show, const std::string& message) {
    begin_area("status", area, fixed | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::AlignTextToFramePadding();
    const float share =
        status.passes_wanted > 0 ? static_cast<float>(status.passes) / static_cast<float>(status.passes_wanted) : 0;
    ImGui::ProgressBar(share, {10 * ImGui::GetFontSize(), 0}, "");
    const std::string state = state_of(status);
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax(),
                 size = ImGui::CalcTextSize(state.c_str());
    ImGui::GetWindowDrawList()->AddText({(low.x + high.x - size.x) / 2, (low.y + high.y - size.y) / 2},
                                        ImGui::GetColorU32(ImGuiCol_Text), state.c_str());
    ImGui::SameLine();
    std::string text = fmt::format("{} samples a pixel", status.passes);
    if (status.seconds_per_pass > 0) text += fmt::format("  |  {:.0f} ms a pass", 1e3 * status.seconds_per_pass);
    if (status.first_seconds > 0) text += fmt::format("  |  first after {:.0f} ms", 1e3 * status.first_seconds);
    text += fmt::format("  |  {} camera rays", counted(status.camera_rays));
    if (status.light_samples > 0) text += fmt::format("  |  {} light samples", counted(status.light_samples));
    if (is_lit_view(show)) text += fmt::format("  |  {:+.2f} EV", std::log2(status.exposure));
    ImGui::TextUnformatted((message.empty() ? text : message).c_str());
    ImGui::End();
}

void draw_help(const Area& area) {
    const float space = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({area.x + space, area.y + space});
    ImGui::SetNextWindowBgAlpha(0.9f);
    // What is never brought to the front is made behind the picture.
    ImGui::Begin("help", nullptr,
                 (fixed & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoInputs);
    for (const auto& [keys, what] : std::array<std::pair<const char*, const char*>, 13>{{
             {"drag, arrow keys", "orbit"},
             {"right drag", "look around"},
             {"middle or shift drag", "pan"},
             {"wheel, + and -", "nearer, farther"},
             {"double click", "orbit around that place"},
             {"W A S D, Q E", "walk, down and up"},
             {"1 2 3", "switch a monitor"},
             {"V", "next kind of shadows"},
             {"M", "measure the exposure again"},
             {"Home", "back to the first view"},
             {"P, X", "save a PNG, an EXR"},
             {"H", "show or hide this list"},
             {"Escape", "close"},
         }}) {
        ImGui::TextUnformatted(keys);
        ImGui::SameLine(11 * space);
        ImGui::TextUnformatted(what);
    }
    ImGui::End();
}

}  // namespace surimi
