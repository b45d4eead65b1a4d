// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/window.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>

#include "runtime/base/error.h"
#include "runtime/window/controls.h"
#include "runtime/window/style.h"

namespace surimi {
namespace {

constexpr float panel_points = 320, status_points = 36;
constexpr double message_seconds = 4;
constexpr int frames_to_settle = 3;  // that Dear ImGui takes until an event has had its whole effect

[[noreturn]] void fail(const std::string& what) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw Error(ErrorKind::usage, fmt::format("{}: {}; a window needs a screen (DISPLAY) with OpenGL 3; without one, "
                                              "write a file with -o",
                                              what, reason != nullptr ? reason : "no reason given"));
}

/// The library, a window, its OpenGL and Dear ImGui in them, for as long as it lives.
class Shell {
  public:
    explicit Shell(const WindowSettings& settings);
    ~Shell();
    Shell(const Shell&) = delete;
    Shell& operator=(const Shell&) = delete;

    GLFWwindow* window() const { return window_; }
    float scale() const { return scale_; }
    ImTextureID texture() const { return reinterpret_cast<ImTextureID>(static_cast<uintptr_t>(texture_)); }
    void upload(const Image<glm::u8vec3>& codes) const;
    Image<glm::u8vec3> read_back() const;

  private:
    GLFWwindow* window_ = nullptr;
    GLuint texture_ = 0;
    float scale_ = 1;
};

Shell::Shell(const WindowSettings& settings) {
    if (!glfwInit()) fail("no window can be opened");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    float other = 1;
    GLFWmonitor* screen = glfwGetPrimaryMonitor();
    if (screen != nullptr) glfwGetMonitorContentScale(screen, &scale_, &other);
    scale_ = std::clamp(scale_, 1.0f, 4.0f);
    int x = 0, y = 0, widest = 16384, highest = 16384;
    if (screen != nullptr) glfwGetMonitorWorkarea(screen, &x, &y, &widest, &highest);
    const int width = settings.width + static_cast<int>(panel_points * scale_);
    const int height = settings.height + static_cast<int>(status_points * scale_);
    window_ = glfwCreateWindow(std::clamp(width, 1, std::max(1, widest)), std::clamp(height, 1, std::max(1, highest)),
                               fmt::format("{} - Surimi", settings.title).c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        // The message is made before the library is left.
        try {
            fail("no window with OpenGL 3 can be opened");
        } catch (...) {
            glfwTerminate();
            throw;
        }
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // nothing is left behind
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init("#version 150");
    set_style(scale_);
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

Shell::~Shell() {
    glDeleteTextures(1, &texture_);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Shell::upload(const Image<glm::u8vec3>& codes) const {
    glBindTexture(GL_TEXTURE_2D, texture_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, codes.width, codes.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                 codes.pixels.data());
}

Image<glm::u8vec3> Shell::read_back() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    Image<glm::u8vec3> pixels(width, height);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.pixels.data());
    for (int y = 0; y < height / 2; ++y)  // OpenGL begins at the bottom
        std::swap_ranges(pixels.pixels.begin() + y * width, pixels.pixels.begin() + (y + 1) * width,
                         pixels.pixels.begin() + (height - 1 - y) * width);
    return pixels;
}

/// What is on screen beside the choices.
struct Session {
    const WindowSettings& settings;
    Sight sight;
    Choices choices;
    Frame frame;
    size_t wish = 0;  // the last one
    bool shows_help = false;
    std::string message;
    double message_ends = 0;  // glfwGetTime
    std::future<std::string> saving;
};

void tell(Session& session, const std::string& message) {
    session.message = message;
    session.message_ends = glfwGetTime() + message_seconds;
}

/// Saves on a thread of its own, since an EXR takes longer than a frame.
void save(Session& session, const std::string& extension) {
    if (session.frame.pixels.empty()) return tell(session, "there is no picture yet");
    if (session.saving.valid()) return tell(session, "the last picture is still being saved");
    session.saving = std::async(std::launch::async, [frame = session.frame, extension, &settings = session.settings] {
        try {
            return "saved " + settings.save(frame, extension);
        } catch (const std::exception& error) {
            return std::string("not saved: ") + error.what();
        }
    });
}

void heed(Session& session, const Requests& requests, GLFWwindow* window) {
    if (requests.wants_close) glfwSetWindowShouldClose(window, GLFW_TRUE);
    if (requests.wants_help) session.shows_help = !session.shows_help;
    if (!requests.save_as.empty()) save(session, requests.save_as);
    if (session.saving.valid() && session.saving.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        tell(session, session.saving.get());
    if (glfwGetTime() > session.message_ends) session.message.clear();
}

/// The picture, filling its area; returns what the hand asks.
Requests draw_picture(const Shell& shell, const Area& area, Session& session) {
    ImGui::SetNextWindowPos({area.x, area.y});
    ImGui::SetNextWindowSize({area.width, area.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("picture", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoBringToFrontOnFocus);
    // One of an old size is stretched until the first of the new size comes.
    if (!session.frame.codes.empty()) ImGui::Image(shell.texture(), {area.width, area.height});
    const Requests requests = use_hand(area, session.sight, session.settings, session.choices);
    ImGui::End();
    ImGui::PopStyleVar();
    return requests;
}

/// One frame of the window, up to what is drawn but not yet shown.
void draw(const Shell& shell, ProgressiveRenderer& renderer, Session& session) {
    if (renderer.take(session.frame)) shell.upload(session.frame.codes);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    const ImGuiIO& io = ImGui::GetIO();
    const float panel = panel_points * shell.scale(), line = status_points * shell.scale();
    const Area picture{0, 0, std::max(1.0f, io.DisplaySize.x - panel), std::max(1.0f, io.DisplaySize.y - line)};
    heed(session, draw_picture(shell, picture, session), shell.window());
    heed(session,
         draw_panel({picture.width, 0, panel, io.DisplaySize.y}, session.settings, session.sight.has_map,
                    session.frame.status, session.choices),
         shell.window());
    draw_status({0, picture.height, picture.width, line}, session.frame.status, session.frame.show, session.message);
    if (session.shows_help) draw_help(picture);
    ImGui::Render();
    // Minimised: the picture of before stays.
    if (io.DisplaySize.x > 0 && io.DisplaySize.y > 0)
        session.wish = renderer.show(
            wish_of(session.choices, static_cast<int>(std::lround(picture.width * io.DisplayFramebufferScale.x)),
                    static_cast<int>(std::lround(picture.height * io.DisplayFramebufferScale.y))));
    int width = 0, height = 0;
    glfwGetFramebufferSize(shell.window(), &width, &height);
    glViewport(0, 0, width, height);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

/// Sleeps until there is something to draw: an event, news from the renderer, a held key or button.
void wait_for_news(int& frames_left) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool is_held = std::any_of(std::begin(io.KeysDown), std::end(io.KeysDown), [](bool is) { return is; }) ||
                         ImGui::IsAnyMouseDown();
    if (is_held) frames_left = frames_to_settle;
    if (frames_left > 0) {
        --frames_left;
        return glfwPollEvents();
    }
    const double before = glfwGetTime();
    constexpr double longest = 0.5;  // seconds: messages go, and text cursors blink
    glfwWaitEventsTimeout(longest);
    if (glfwGetTime() - before < longest) frames_left = frames_to_settle;
}

}  // namespace

void open_window(Lighting lighting, const Choices& choices, const WindowSettings& settings) {
    const Shell shell(settings);
    Session session{settings, {lighting.rays, !lighting.pages.empty()}, choices, {}, 0, false, {}, 0, {}};
    ProgressiveRenderer renderer(std::move(lighting), [] { glfwPostEmptyEvent(); });
    int frames_left = frames_to_settle;
    for (int frame = 1; !glfwWindowShouldClose(shell.window()); ++frame) {
        wait_for_news(frames_left);
        draw(shell, renderer, session);
        const bool is_finished =
            session.frame.status.is_done && session.frame.status.wish == session.wish && frame > frames_to_settle;
        if (settings.screenshot && (is_finished || frame == settings.most_frames)) {
            settings.screenshot(shell.read_back());
            return;
        }
        glfwSwapBuffers(shell.window());
    }
    if (session.saving.valid()) session.saving.wait();
}

}  // namespace surimi
