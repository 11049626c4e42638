// SPDX-License-Identifier: MIT
#include "tests/window/drop_source.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <chrono>
#include <thread>

namespace candela::test {

namespace {

class DropSource {
  public:
    DropSource(const std::string& display_name, Window target, std::string path)
        : display_(XOpenDisplay(display_name.c_str())), target_(target), uri_("file://" + std::move(path) + "\r\n") {
        if (display_ != nullptr) own_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0);
    }
    ~DropSource() {
        if (display_ != nullptr) XCloseDisplay(display_);
    }
    DropSource(const DropSource&) = delete;
    DropSource& operator=(const DropSource&) = delete;

    bool run() {
        if (display_ == nullptr) return false;
        XSetSelectionOwner(display_, atom("XdndSelection"), own_, CurrentTime);

        // Enter with the one type that we have, then say where the pointer is.
        send("XdndEnter", 5L << 24, static_cast<long>(atom("text/uri-list")), 0, 0);
        Window root = 0, child = 0;
        int x = 0, y = 0;
        unsigned width = 0, height = 0, border = 0, depth = 0;
        XGetGeometry(display_, target_, &root, &x, &y, &width, &height, &border, &depth);
        XTranslateCoordinates(display_, target_, root, static_cast<int>(width / 2), static_cast<int>(height / 2), &x,
                              &y, &child);
        send("XdndPosition", 0, (static_cast<long>(x) << 16) | y, CurrentTime,
             static_cast<long>(atom("XdndActionCopy")));

        // Let go once the target agrees; hand over the name when it asks.
        XEvent event;
        if (!wait_for("XdndStatus", event) || (event.xclient.data.l[1] & 1) == 0) return false;
        send("XdndDrop", 0, CurrentTime, 0, 0);
        return wait_for("XdndFinished", event);
    }

  private:
    Atom atom(const char* name) { return XInternAtom(display_, name, False); }

    void send(const char* type, long l1, long l2, long l3, long l4) {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target_;
        event.xclient.message_type = atom(type);
        event.xclient.format = 32;
        const long data[] = {static_cast<long>(own_), l1, l2, l3, l4};
        std::copy(std::begin(data), std::end(data), event.xclient.data.l);
        XSendEvent(display_, target_, False, NoEventMask, &event);
        XFlush(display_);
    }

    bool wait_for(const char* type, XEvent& event) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (std::chrono::steady_clock::now() < end) {
            while (XPending(display_) > 0) {
                XNextEvent(display_, &event);
                if (event.type == SelectionRequest) answer(event.xselectionrequest);
                if (event.type == ClientMessage && event.xclient.message_type == atom(type)) return true;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return false;
    }

    void answer(const XSelectionRequestEvent& request) {
        XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(uri_.data()), static_cast<int>(uri_.size()));
        XEvent reply{};
        reply.xselection.type = SelectionNotify;
        reply.xselection.requestor = request.requestor;
        reply.xselection.selection = request.selection;
        reply.xselection.target = request.target;
        reply.xselection.property = request.property;
        reply.xselection.time = request.time;
        XSendEvent(display_, request.requestor, False, NoEventMask, &reply);
        XFlush(display_);
    }

    Display* display_;
    Window target_, own_ = 0;
    std::string uri_;
};

}  // namespace

bool drop_file(const std::string& display_name, unsigned long window, const std::string& path) {
    return DropSource(display_name, window, path).run();
}

}  // namespace candela::test
