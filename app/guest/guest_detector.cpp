#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/base/text.h"
#include "app/guest/guest_process.h"
#include "collide/core/body_boxes.h"
#include "collide/core/contact_sort.h"

namespace app::guest {
namespace {

class GuestDetector final : public collide::Detector {
 public:
  explicit GuestDetector(std::shared_ptr<const Guest> guest) : guest_(std::move(guest)) {}

  /// Throws std::runtime_error with what the guest did wrong; then also for other frames, until its file has changed.
  void detect(const collide::Frame& frame, const collide::Settings& settings, collide::Workers&,
              collide::Result& result) override {
    if (const auto build = guest_->build(); build != build_) {
      build_ = build;
      process_.reset();
      problem_ = build->problem;
    }
    if (problem_.empty()) try {
        search(frame, settings, result);
      } catch (const std::exception& error) {
        process_.reset();
        problem_ = guest_->file().filename().string() + ": " + failure_text(error);
      }
    if (!problem_.empty()) throw std::runtime_error(problem_);
  }
  void forget() override { forget_ = true; }

 private:
  void search(const collide::Frame& frame, const collide::Settings& settings, collide::Result& result) {
    live_.build(frame, result);
    Request request = write(frame);
    if (!process_ || process_->frame().size() < words_.size())
      process_.emplace(*guest_, *build_->library, words_.size() + words_.size() / 2);
    std::ranges::copy(words_, process_->frame().begin());
    request.tolerance = settings.tolerance;
    request.forget = std::exchange(forget_, false);
    // Ten times what brute force takes, at a nanosecond a pair.
    request.seconds = std::max(2.0, 10e-9 * request.vertices * (request.vertices - 1.0) / 2);
    const Reply found = process_->search(request);
    take(found.pairs, frame, settings, result);
    result.own_ms = found.ms;
    result.coverage = collide::Coverage::unknown;
  }

  /// Writes what the guest sees into words_: the vertices and meshes of all bodies that are finite. The others have no
  /// vertices.
  Request write(const collide::Frame& frame) {
    const collide::Bodies& bodies = *frame.bodies;
    first_.assign(bodies.count() + std::size_t{1}, 0);
    for (const collide::Index body : live_.live) first_[body + std::size_t{1}] = bodies.size(body);
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    words_.clear();
    for (const std::span<const float> axis : {frame.x, frame.y, frame.z})
      for (const collide::Index body : live_.live)
        for (const float value : axis.subspan(bodies.first[body], bodies.size(body)))
          words_.push_back(std::bit_cast<std::uint32_t>(value));
    words_.insert(words_.end(), first_.begin(), first_.end());
    const std::size_t edges = words_.size();
    for (const collide::Index body : live_.live)
      for (collide::Index v = 0; v < bodies.size(body); ++v)
        for (const collide::Index neighbour : bodies.shape[body]->topology().neighbours(v))
          if (v < neighbour) words_.insert(words_.end(), {first_[body] + v, first_[body] + neighbour});
    const std::size_t triangles = words_.size();
    for (const collide::Index body : live_.live)
      for (const auto& [a, b, c] : bodies.shape[body]->topology().triangles())
        words_.insert(words_.end(), {first_[body] + a, first_[body] + b, first_[body] + c});
    return {.vertices = first_.back(),
            .bodies = bodies.count(),
            .edges = static_cast<std::uint32_t>((triangles - edges) / 2),
            .triangles = static_cast<std::uint32_t>((words_.size() - triangles) / 3)};
  }

  /// Takes the pairs that count, whatever their distance: two vertices of different bodies, or of one body whose shape
  /// does not exclude them.
  void take(std::uint64_t pairs, const collide::Frame& frame, const collide::Settings& settings,
            collide::Result& result) const {
    const collide::Bodies& bodies = *frame.bodies;
    const auto body_of = [&](collide::Index vertex) {
      return static_cast<std::size_t>(std::ranges::upper_bound(first_, vertex) - first_.begin()) - 1;
    };
    std::vector<collide::Contact>& contacts = result.contacts;
    for (std::uint64_t i = 0; i < pairs; ++i) {
      const auto [a, b] = std::minmax({process_->pairs()[2 * i], process_->pairs()[2 * i + 1]});
      if (b >= first_.back())
        throw std::runtime_error(fmt::format("hands over vertex {}, but there are only {}", b, first_.back()));
      if (a != b) contacts.push_back({a, b});
    }
    collide::ContactSort().sort(contacts, {0, first_.back()});
    contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
    std::erase_if(contacts, [&](collide::Contact& contact) {
      auto& [a, b] = contact;
      const std::size_t body = body_of(a), other = body_of(b);
      if (body == other &&
          (!settings.self_collision ||
           bodies.shape[body]->excludes(a - first_[body], b - first_[body], settings.tolerance * settings.tolerance)))
        return true;
      result.self_contacts += body == other;
      contact = {a - first_[body] + bodies.first[body], b - first_[other] + bodies.first[other]};
      return false;
    });
  }

  std::shared_ptr<const Guest> guest_;
  std::shared_ptr<const Build> build_;
  std::string problem_;
  std::optional<GuestProcess> process_;
  bool forget_ = false;
  collide::BodyBoxes live_;
  std::vector<std::uint32_t> words_;   // see Request
  std::vector<collide::Index> first_;  // of each body in them, and one more
};

}  // namespace

std::unique_ptr<collide::Detector> make_detector(std::shared_ptr<const Guest> guest) {
  return std::make_unique<GuestDetector>(std::move(guest));
}

}  // namespace app::guest
