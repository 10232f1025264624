#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include <SDL2/SDL.h>

#include "wheel/view.h"
#include "world/check.h"

namespace reprise::wheel {

namespace {

constexpr int usual_width = 960;  // [px] of a window, before anybody sizes it
constexpr int usual_height = 540;

struct Free {
    void operator()(SDL_Window* window) const { SDL_DestroyWindow(window); }

    void operator()(SDL_Renderer* renderer) const { SDL_DestroyRenderer(renderer); }

    void operator()(SDL_Texture* texture) const { SDL_DestroyTexture(texture); }

    void operator()(SDL_GameController* pad) const { SDL_GameControllerClose(pad); }
};

/// SDL itself; it is the process's.
struct Sdl {
    Sdl() {
        SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // Ctrl-C is the run's
        SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "linear");
        SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
        if (SDL_Init(SDL_INIT_VIDEO) != 0)
            throw world::Error(std::string("no window: ") + SDL_GetError());
        // Where there is no screen, SDL takes one that nobody sees, unless it was asked for.
        const std::string_view driver = SDL_GetCurrentVideoDriver();
        if (std::getenv("SDL_VIDEODRIVER") == nullptr &&
            (driver == "offscreen" || driver == "dummy")) {
            SDL_Quit();
            throw world::Error("no window: DISPLAY and WAYLAND_DISPLAY name no screen");
        }
        SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER);  // where it fails there is none
    }

    ~Sdl() { SDL_Quit(); }

    Sdl(const Sdl&) = delete;
    Sdl& operator=(const Sdl&) = delete;
};

class Window : public View {
  public:
    explicit Window(const Clock& clock)
        : clock_(clock),
          window_(SDL_CreateWindow(
              "Reprise",
              SDL_WINDOWPOS_UNDEFINED,
              SDL_WINDOWPOS_UNDEFINED,
              usual_width,
              usual_height,
              SDL_WINDOW_HIDDEN | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI)) {
        if (window_ != nullptr)
            renderer_.reset(SDL_CreateRenderer(window_.get(), -1, 0));
        if (renderer_ == nullptr)
            throw world::Error(std::string("no window: ") + SDL_GetError());
        SDL_ShowWindow(window_.get());  // now: SDL makes it anew for what draws in it
    }

    Wishes wait(double seconds) override {
        constexpr double milliseconds = 1e3;
        const double until = clock_() + seconds;
        Wishes wishes;
        for (;;) {
            SDL_Event event;
            while (SDL_PollEvent(&event) != 0)
                hear(event, wishes);
            const double left = until - clock_();
            if (wishes.end || left <= 0)
                break;
            if (SDL_WaitEventTimeout(&event, static_cast<int>(left * milliseconds) + 1) != 0)
                hear(event, wishes);
        }
        add_held(wishes);
        add_pad(wishes);
        return wishes;
    }

    void show(const Image* image, const std::string& line) override {
        SDL_SetWindowTitle(window_.get(), ("Reprise   " + line).c_str());
        SDL_SetRenderDrawColor(renderer_.get(), 24, 24, 26, 255);
        SDL_RenderClear(renderer_.get());
        if (image != nullptr)
            draw(*image);
        SDL_RenderPresent(renderer_.get());
    }

  private:
    void draw(const Image& image) {
        if (texture_ == nullptr || image.width != width_ || image.height != height_) {
            texture_.reset(SDL_CreateTexture(renderer_.get(),
                                             SDL_PIXELFORMAT_RGB24,
                                             SDL_TEXTUREACCESS_STREAMING,
                                             image.width,
                                             image.height));
            width_ = image.width;
            height_ = image.height;
            SDL_RenderSetLogicalSize(renderer_.get(), width_, height_);
        }
        SDL_UpdateTexture(texture_.get(), nullptr, image.rgb.data(), 3 * image.width);
        SDL_RenderCopy(renderer_.get(), texture_.get(), nullptr, nullptr);
    }

    /// Keys are where they are on every keyboard, whatever is printed on them.
    void hear(const SDL_Event& event, Wishes& wishes) {
        if (event.type == SDL_QUIT)
            wishes.end = true;
        if (event.type == SDL_CONTROLLERDEVICEADDED && pad_ == nullptr)
            pad_.reset(SDL_GameControllerOpen(event.cdevice.which));
        if (event.type == SDL_CONTROLLERDEVICEREMOVED)
            pad_.reset();
        if (event.type == SDL_CONTROLLERBUTTONDOWN &&
            event.cbutton.button == SDL_CONTROLLER_BUTTON_X)
            ++wishes.gear;
        if (event.type != SDL_KEYDOWN || event.key.repeat != 0)
            return;
        switch (event.key.keysym.scancode) {
            case SDL_SCANCODE_ESCAPE:
            case SDL_SCANCODE_Q:
                wishes.end = true;
                break;
            case SDL_SCANCODE_R:
                ++wishes.gear;
                break;
            case SDL_SCANCODE_TAB:
                ++wishes.sensor;
                break;
            case SDL_SCANCODE_P:
                ++wishes.pause;
                break;
            // Down and up again between two looks counts all the same.
            case SDL_SCANCODE_UP:
            case SDL_SCANCODE_W:
                wishes.ahead = true;
                break;
            case SDL_SCANCODE_DOWN:
            case SDL_SCANCODE_S:
                wishes.back = true;
                break;
            case SDL_SCANCODE_LEFT:
            case SDL_SCANCODE_A:
                wishes.left = true;
                break;
            case SDL_SCANCODE_RIGHT:
            case SDL_SCANCODE_D:
                wishes.right = true;
                break;
            case SDL_SCANCODE_SPACE:
                wishes.hand_brake = true;
                break;
            default:
                break;
        }
    }

    static void add_held(Wishes& wishes) {
        const Uint8* down = SDL_GetKeyboardState(nullptr);
        const auto either = [&](SDL_Scancode one, SDL_Scancode other) {
            return down[one] != 0 || down[other] != 0;
        };
        wishes.ahead |= either(SDL_SCANCODE_UP, SDL_SCANCODE_W);
        wishes.back |= either(SDL_SCANCODE_DOWN, SDL_SCANCODE_S);
        wishes.left |= either(SDL_SCANCODE_LEFT, SDL_SCANCODE_A);
        wishes.right |= either(SDL_SCANCODE_RIGHT, SDL_SCANCODE_D);
        wishes.hand_brake |= down[SDL_SCANCODE_SPACE] != 0;
    }

    /// Left stick, right and left trigger, A; a steering wheel that SDL knows is one of these, too.
    void add_pad(Wishes& wishes) const {
        constexpr double full = 32767;
        constexpr double untouched = 0.08;
        if (pad_ == nullptr)
            return;
        const auto axis = [&](SDL_GameControllerAxis which) {
            const double value = SDL_GameControllerGetAxis(pad_.get(), which) / full;
            return std::abs(value) < untouched ? 0.0 : std::clamp(value, -1.0, 1.0);
        };
        const double stick = -axis(SDL_CONTROLLER_AXIS_LEFTX);
        wishes.steer = stick * std::abs(stick);  // finer around the middle
        wishes.throttle = axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT);
        wishes.brake = axis(SDL_CONTROLLER_AXIS_TRIGGERLEFT);
        wishes.hand_brake |= SDL_GameControllerGetButton(pad_.get(), SDL_CONTROLLER_BUTTON_A) != 0;
    }

    Sdl sdl_;
    Clock clock_;
    std::unique_ptr<SDL_Window, Free> window_;
    std::unique_ptr<SDL_Renderer, Free> renderer_;
    std::unique_ptr<SDL_Texture, Free> texture_;
    std::unique_ptr<SDL_GameController, Free> pad_;
    int width_ = 0;  ///< [px] of the texture
    int height_ = 0;
};

}  // namespace

std::unique_ptr<View> open_window(const Clock& clock) {
    return std::make_unique<Window>(clock);
}

}  // namespace reprise::wheel
