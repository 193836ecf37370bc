#include "app/guest/guest_process.h"

#include <chrono>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "app/base/timings.h"
#include "collide/api/sbcollide/method.h"

namespace app::guest {
namespace {

constexpr std::string_view guest_argument = "--guest-process";
constexpr std::size_t max_pairs = std::size_t{1} << 27, bytes_of_pairs = 2 * sizeof(collide::Index) * max_pairs;
constexpr std::size_t memory_limit = std::size_t{4} << 30;  // bytes
constexpr double max_loading = 10;                          // s

// ---- in the guest's process ----

template <std::size_t size>
void copy(std::string_view text, std::array<char, size>& to) {
  to[text.copy(to.data(), size - 1)] = 0;
}

class Server {
 public:
  /// Answers until nobody asks any more.
  [[noreturn]] void run() {
    answer([this] { load(); });
    Request request;
    while (receive(Process::channel_inside, std::as_writable_bytes(std::span(&request, 1))))
      answer([&] { search(request); });
    std::_Exit(EXIT_SUCCESS);
  }

 private:
  template <class Action>
  void answer(const Action& action) {
    reply_ = {};
    try {
      action();
    } catch (const std::bad_alloc&) {
      copy("takes more than 4 GiB of memory", reply_.error);
    } catch (const std::exception& error) {
      copy(error.what(), reply_.error);
    }
    send_reply();
  }
  static void send_reply() { send(Process::channel_inside, std::as_bytes(std::span(&reply_, 1))); }

  void load() {
    const auto guest =
        reinterpret_cast<const sbcollide_method* (*)()>(load_function(Process::first_handle, "sbcollide_guest"));
    method_ = guest();
    if (!method_) throw std::runtime_error("sbcollide_guest() returns NULL");
    if (method_->version != SBCOLLIDE_METHOD_VERSION)
      throw std::runtime_error(fmt::format(
          "a wrong version: it is made for version {} of sbcollide/method.h, and this program has {}: compile it anew",
          method_->version, SBCOLLIDE_METHOD_VERSION));
    if (!method_->key || !method_->name || !method_->summary || !method_->find)
      throw std::runtime_error("its method lacks a key, a name, a summary or find()");
    copy(method_->key, reply_.key);
    copy(method_->name, reply_.name);
    copy(method_->summary, reply_.summary);
  }

  void search(const Request& request) {
    if (has_self_ && request.forget && method_->destroy) method_->destroy(self_);
    if ((!has_self_ || request.forget) && method_->make) self_ = method_->make();
    has_self_ = true;
    const auto* word = reinterpret_cast<const std::uint32_t*>(memory_.data() + bytes_of_pairs);
    const auto next = [&word](std::size_t count) { return std::exchange(word, word + count); };
    const auto axis = [&] { return reinterpret_cast<const float*>(next(request.vertices)); };
    const float *x = axis(), *y = axis(), *z = axis();
    const std::uint32_t *first = next(request.bodies + std::size_t{1}), *edges = next(std::size_t{2} * request.edges);
    const sbcollide_frame frame{
        request.vertices, request.bodies, request.edges, request.triangles, x, y, z, first, edges, word};
    auto* begin = reinterpret_cast<std::uint32_t*>(memory_.data());
    sbcollide_pairs pairs{begin, begin + 2 * max_pairs, [](sbcollide_pairs*) {
                            copy(fmt::format("over its pairs: more than {} in one frame", max_pairs), reply_.error);
                            send_reply();
                            std::_Exit(EXIT_FAILURE);
                          }};
    reply_.ms = time_ms([&] { method_->find(self_, &frame, request.tolerance, &pairs); });
    reply_.pairs = static_cast<std::uint64_t>(pairs.next - begin) / 2;
  }

  static inline Reply reply_{};
  std::span<std::byte> memory_ = take_memory(Process::first_handle + 1, bytes_of_pairs);
  const sbcollide_method* method_ = nullptr;
  void* self_ = nullptr;
  bool has_self_ = false;
};

}  // namespace

void run_if_guest(int count, char** arguments) {
  if (count != 2 || arguments[1] != guest_argument) return;
  Server server;
  confine(memory_limit);
  server.run();
}

// ---- in the process that asks it ----

GuestProcess::GuestProcess(const Guest& guest, const SharedMemory& library, std::size_t words)
    : guest_(guest),
      memory_(bytes_of_pairs + sizeof(std::uint32_t) * words),
      process_({Process::this_program, std::string(guest_argument)}, -1, {library.handle(), memory_.handle()}),
      introduction_(reply(max_loading)) {}

std::span<std::uint32_t> GuestProcess::frame() const {
  const std::span<std::byte> bytes = memory_.bytes().subspan(bytes_of_pairs);
  return {reinterpret_cast<std::uint32_t*>(bytes.data()), bytes.size() / sizeof(std::uint32_t)};
}

Reply GuestProcess::search(const Request& request) {
  send(process_.channel(), std::as_bytes(std::span(&request, 1)));
  return reply(request.seconds);
}

Reply GuestProcess::reply(double seconds) {
  using Clock = std::chrono::steady_clock;
  for (const auto latest = Clock::now() + std::chrono::duration<double>(seconds); !guest_.stopped();) {
    Reply reply;
    const auto end = process_.end();  // asked for first: its last message may come before its end
    if (receive(process_.channel(), std::as_writable_bytes(std::span(&reply, 1)), 20)) {
      for (auto* text : {&reply.error, &reply.key, &reply.name, &reply.summary}) {
        text->back() = 0;
        for (char& c : *text)
          if (c > 0 && c < ' ') c = ' ';  // a text is one line
      }
      if (reply.error[0] != 0) throw std::runtime_error(reply.error.data());
      if (reply.pairs > max_pairs) throw std::runtime_error("says that it has found more pairs than there is room for");
      return reply;
    }
    if (end) throw std::runtime_error(*end);
    if (Clock::now() > latest) throw std::runtime_error(fmt::format("over its time: {:.3g} s", seconds));
  }
  throw std::runtime_error("was stopped");
}

}  // namespace app::guest
