// Arbitrary queries of continuous collision detection, against rational arithmetic and against themselves put
// otherwise.

#include <bit>
#include <cmath>

#include "bytes.h"
#include "require.h"
#include "tests/collide/ccd_truth.h"

namespace fuzz {
namespace {

using collide::oracle::Meeting;
using collide::oracle::MovingPoint;
using collide::test::Query;

/// Reads points that often coincide, rest, or lie in one plane.
class QueryReader {
 public:
  explicit QueryReader(Bytes bytes) : bytes_(bytes), any_bits_(bytes_.below(4) == 0) {}

  Query read() {
    Query query{bytes_.below(2) == 0 ? Query::Kind::vertex_face : Query::Kind::edge_edge, {}};
    for (std::size_t k = 0; k < 4; ++k) {
      MovingPoint& p = query.points[k];
      const MovingPoint& other = query.points[std::size_t(bytes_.below(4))];
      p.from = bytes_.below(8) == 0 ? other.from : position();
      p.to = bytes_.below(8) == 0 ? p.from : bytes_.below(8) == 0 ? p.from + (other.to - other.from) : position();
    }
    return query;
  }
  /// Returns true if coordinates may be any doubles. For these, rational arithmetic takes too long.
  bool any_bits() const { return any_bits_; }

 private:
  glm::dvec3 position() { return {coordinate(), coordinate(), coordinate()}; }
  double coordinate() {
    const double small = bytes_.below(5) - 2;
    switch (bytes_.below(8)) {
      case 0:
        return static_cast<double>(bytes_.fraction());
      case 1:
        return std::nextafter(1.0, small);
      case 2:
        return std::ldexp(small, bytes_.below(200) - 100);
      case 3: {
        if (!any_bits_) return 3 * small;
        const auto x = std::bit_cast<double>(std::uint64_t{bytes_.word()} << 32 | bytes_.word());
        return std::isfinite(x) ? x : 0;
      }
      default:
        return small;
    }
  }

  Bytes bytes_;
  bool any_bits_;
};

Query backwards(Query query) {
  for (MovingPoint& p : query.points) std::swap(p.from, p.to);
  return query;
}
Query mirrored(Query query) {
  std::swap(query.points[2], query.points[3]);
  return query;
}

bool overlap(const Meeting& a, const Meeting& b) { return a.low <= b.high && b.low <= a.high; }

void check(const Query& query, bool know_truth) {
  const auto meeting = collide::oracle::meeting_of(query);
  const auto passage = collide::oracle::passage_of(query);
  if (meeting) {
    require(0 <= meeting->low && meeting->low <= meeting->high && meeting->high <= 1, "times out of order");
    require(meeting->high - meeting->low <= 1e-12, "a wide enclosure");
  }
  require(!passage || (meeting && passage->time >= meeting->low), "a passage before any meeting");
  const auto other = collide::oracle::meeting_of(mirrored(query));
  require(meeting.has_value() == other.has_value(), "a mirrored query has another answer");
  require(!meeting || overlap(*meeting, *other), "a mirrored query has another time");
  require(meeting.has_value() == collide::oracle::meeting_of(backwards(query)).has_value(),
          "backwards, another answer");
  require(passage.has_value() == collide::oracle::passage_of(backwards(query)).has_value(),
          "backwards, another passage");
  if (!know_truth) return;
  const collide::test::Truth truth = collide::test::truth_of(query);
  require(meeting.has_value() == truth.first_meeting.has_value(), "a wrong answer about meeting");
  require(passage.has_value() == truth.first_passage.has_value(), "a wrong answer about passing");
  require(!passage || passage->inward == truth.first_passage->inward, "a passage the other way");
  require(!passage || std::abs(passage->time - truth.first_passage->time) <= 1e-12, "a wrong time of a passage");
  require(!meeting || overlap(*meeting, {*truth.first_meeting - 1e-15, *truth.first_meeting + 1e-15}), "a wrong time");
}

}  // namespace
}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::QueryReader reader{fuzz::Bytes({data, size})};
  const collide::test::Query query = reader.read();
  for (const collide::oracle::MovingPoint& p : query.points) {
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(p.from[axis]) || !std::isfinite(p.to[axis])) return 0;  // moved with another point
    }
  }
  fuzz::check(query, !reader.any_bits());
  return 0;
}
