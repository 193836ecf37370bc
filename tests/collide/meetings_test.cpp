// Whether moving features meet, against queries whose truth is known: from the public benchmark, by construction, and
// by rational arithmetic written apart.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

#include "ccd_truth.h"

namespace collide::test {

using namespace collide::oracle;

namespace THIS_FILE {

using Kind = Query::Kind;

std::string text_of(const Query& query) {
  std::ostringstream text;
  text.precision(17);
  text << (query.kind == Kind::vertex_face ? "vf" : "ee");
  for (const auto time : {&MovingPoint::from, &MovingPoint::to}) {
    for (const MovingPoint& p : query.points) {
      for (glm::length_t axis = 0; axis < 3; ++axis) text << ',' << (p.*time)[axis];
    }
  }
  return text.str();
}

/// Expects the first meeting at a time, or none.
void expect_meeting(const Query& query, std::optional<double> time) {
  const std::optional<Meeting> meeting = meeting_of(query);
  ASSERT_EQ(meeting.has_value(), time.has_value()) << text_of(query);
  if (!meeting) return;
  EXPECT_LE(meeting->high - meeting->low, 1e-12) << text_of(query);
  EXPECT_LE(meeting->low, *time + 1e-15) << text_of(query);
  EXPECT_GE(meeting->high, *time - 1e-15) << text_of(query);
  EXPECT_TRUE(0 <= meeting->low && meeting->low <= meeting->high && meeting->high <= 1) << text_of(query);
}

TEST(Meetings, ArePreciselyThoseOfThePublicQueries) {
  const char* const folder = std::getenv("CCD_DATA");
  if (!folder) GTEST_SKIP() << "CCD_DATA names no folder of public queries";
  std::size_t queries = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".csv") continue;
    std::size_t line = 0;
    for (const KnownQuery& query : read_queries(entry.path())) {
      ++line;
      const std::optional<Meeting> meeting = meeting_of(query);
      EXPECT_EQ(meeting.has_value(), query.meets) << entry.path() << ':' << line;
      EXPECT_TRUE(!meeting || meeting->high - meeting->low <= 1e-12) << entry.path() << ':' << line;
      EXPECT_TRUE(meeting || !passage_of(query)) << entry.path() << ':' << line;
      ++queries;
    }
  }
  EXPECT_GT(queries, 0u);
}

TEST(Meetings, OfTheFirstAndTheLastInstantCount) {
  const glm::dvec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0), above(1, 1, 1), on(1, 1, 0);
  const auto query = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return Query{Kind::vertex_face, {{{from, to}, {a, a}, {b, b}, {c, c}}}};
  };
  expect_meeting(query(above, on), 1);
  expect_meeting(query(on, above), 0);
  expect_meeting(query(above, above + glm::dvec3(0, 0, std::nextafter(-1, 0))), std::nullopt);
  expect_meeting(query(above, {1, 1, std::numeric_limits<double>::denorm_min()}), std::nullopt);
}

TEST(Meetings, AreTheFirstOfThreeInOneStep) {
  const Query query{Kind::edge_edge,
                    {{{{0.5, -0.5, 3.75}, {-1.5, 5.5, 4.75}},
                      {{-2.5, -1, 3.5}, {-0.5, -5, 5.5}},
                      {{-3.5, 0.25, 4.75}, {-7.5, -1.75, 1.75}},
                      {{1.5, -1, 2.75}, {1.5, -6, 7.75}}}}};
  const std::optional<Meeting> meeting = meeting_of(query);  // the others: at 0.25 and at 0.563
  ASSERT_TRUE(meeting);
  EXPECT_LT(meeting->high, 0.25);
  expect_meeting(query, truth_of(query).first_meeting);
}

TEST(Meetings, CountWhileFeaturesRestOrSlideInOnePlane) {
  const glm::dvec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0), far(8, 0, 0), on(1, 1, 0);
  const auto vertex_face = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return Query{Kind::vertex_face, {{{from, to}, {a, a}, {b, b}, {c, c}}}};
  };
  expect_meeting(vertex_face(on, on), 0);
  expect_meeting(vertex_face(far, far), std::nullopt);
  expect_meeting(vertex_face(far, a), 0.5);
  expect_meeting(vertex_face(glm::dvec3(8, 8, 0), a), 0.75);
  const auto edges = [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& by) {
    return Query{Kind::edge_edge, {{{p, p + by}, {q, q + by}, {a, a}, {b, b}}}};
  };
  expect_meeting(edges({5, 0, 0}, {7, 0, 0}, {-2, 0, 0}), 0.5);             // in one line
  expect_meeting(edges({0, 1, 0}, {4, 1, 0}, {0, -4, 0}), 0.25);            // side by side
  expect_meeting(edges({5, 1, 0}, {9, 1, 0}, {0, -4, 0}), std::nullopt);    // beside it in one line, at 0.25
  expect_meeting(edges({1, 1, 0}, {3, 2, 0}, {0, -2, 0}), 0.5);             // an end first
  expect_meeting(edges({2, 1, 0}, {2, 1, 0}, {0, -1, 0}), 1);               // an edge of no length
  expect_meeting(edges({2, 1, 0}, {2, 1, 0}, {1, -0.5, 0}), std::nullopt);  // an edge of no length
}

TEST(Meetings, CountWithFacesThatHaveNoAreaAndPointsThatCoincide) {
  const glm::dvec3 a(1, 2, 3), d(2, 4, 6), e(3, 6, 9), beside(2, 4, 7);
  const auto still = [](const glm::dvec3& p) { return MovingPoint{p, p}; };
  for (const auto& [p, meets] : {std::pair(a, true), {d, true}, {e, true}, {beside, false}}) {
    const std::optional<double> time = meets ? std::optional(0.0) : std::nullopt;
    expect_meeting({Kind::vertex_face, {still(p), still(a), still(e), still(d)}}, time);
    expect_meeting({Kind::vertex_face, {still(p), still(a), still(e), still(a)}}, time);
    expect_meeting({Kind::edge_edge, {still(p), still(p), still(a), still(e)}}, time);
    const std::optional<double> same = p == a ? time : std::nullopt;
    expect_meeting({Kind::vertex_face, {still(p), still(a), still(a), still(a)}}, same);
    expect_meeting({Kind::edge_edge, {still(p), still(p), still(a), still(a)}}, same);
  }
}

/// Returns a coordinate.
using Coordinate = std::function<double(std::mt19937_64&)>;

double any_of(std::mt19937_64& random, std::initializer_list<double> values) {
  return values.begin()[random() % values.size()];
}
double small_integer(std::mt19937_64& random) { return static_cast<double>(random() % 3); }
double any_real(std::mt19937_64& random) { return std::uniform_real_distribution<double>(-1, 1)(random); }
double off_by_one_digit(std::mt19937_64& random) {
  const double x = 1 + small_integer(random);
  return any_of(random, {x, x, x, x, std::nextafter(x, 0), std::nextafter(x, 9)});
}
double of_any_magnitude(std::mt19937_64& random) {
  return any_of(random, {0, 1e-30, -1e-30, 7e-31, 0.5, 1, -1, 3e29, 1e30, -1e30});
}

Query random_query(std::mt19937_64& random, const Coordinate& coordinate) {
  Query query{random() % 2 == 0 ? Kind::vertex_face : Kind::edge_edge, {}};
  for (MovingPoint& p : query.points) {
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      p.from[axis] = coordinate(random);
      p.to[axis] = coordinate(random);
    }
  }
  return query;
}

/// Makes half of all queries degenerate, in one of several ways.
void degenerate(Query& query, std::mt19937_64& random) {
  auto& p = query.points;
  const auto each = [&](const auto& change) {
    for (MovingPoint& point : p) {
      change(point.from);
      change(point.to);
    }
  };
  switch (random() % 18) {
    case 0:
      p[1] = p[0];  // an edge of no length, or the vertex is a corner
      break;
    case 1:
      p[3] = p[2];  // an edge of no length, or a face of no area
      break;
    case 2:
      p[1].from = p[2].from;  // for a moment
      break;
    case 3:
      each([](glm::dvec3& x) { x.z = 0; });
      break;
    case 4:
      each([](glm::dvec3& x) { x.z = x.x; });
      break;
    case 5:
      each([](glm::dvec3& x) { x.y = x.z = x.x; });
      break;
    case 6:
      for (MovingPoint& point : p) point.to = point.from;
      break;
    case 7:
      for (MovingPoint& point : p) point.to = point.from + (p[0].to - p[0].from);  // together
      break;
    case 8:
      for (std::size_t k = 1; k < 4; ++k) p[k].to = p[k].from;
      break;
    default:
      break;
  }
}

struct Sample {
  const char* name;
  Coordinate coordinate;
  int count;
};

class MeetingsOf : public testing::TestWithParam<Sample> {};

TEST_P(MeetingsOf, AgreeWithRationalArithmetic) {
  std::mt19937_64 random(49);
  int met = 0, passed = 0;
  for (int i = 0; i < GetParam().count; ++i) {
    Query query = random_query(random, GetParam().coordinate);
    degenerate(query, random);
    const Truth truth = truth_of(query);
    expect_meeting(query, truth.first_meeting);
    ASSERT_EQ(passage_of(query).has_value(), truth.passes) << text_of(query);
    met += truth.first_meeting.has_value();
    passed += truth.passes;
  }
  EXPECT_GT(met, GetParam().count / 10);
  EXPECT_GT(passed, 0);
}

/// What does not depend on how the features are named, on the direction of time, or on the unit.
TEST_P(MeetingsOf, DoNotDependOnHowTheQueryIsPut) {
  std::mt19937_64 random(50);
  for (int i = 0; i < 10 * GetParam().count; ++i) {
    Query query = random_query(random, GetParam().coordinate);
    degenerate(query, random);
    const std::optional<Meeting> meeting = meeting_of(query);
    const std::optional<double> time = meeting ? std::optional((meeting->low + meeting->high) / 2) : std::nullopt;
    auto& p = query.points;
    const Query backwards{query.kind,
                          {{{p[0].to, p[0].from}, {p[1].to, p[1].from}, {p[2].to, p[2].from}, {p[3].to, p[3].from}}}};
    ASSERT_EQ(meeting_of(backwards).has_value(), meeting.has_value()) << text_of(query);
    ASSERT_EQ(passage_of(backwards).has_value(), passage_of(query).has_value()) << text_of(query);
    if (query.kind == Kind::vertex_face) {
      expect_meeting({query.kind, {p[0], p[2], p[3], p[1]}}, time);
      expect_meeting({query.kind, {p[0], p[2], p[1], p[3]}}, time);
    } else {
      expect_meeting({query.kind, {p[1], p[0], p[2], p[3]}}, time);
      expect_meeting({query.kind, {p[3], p[2], p[1], p[0]}}, time);
    }
    for (MovingPoint& point : p) point = {point.from * -0x1p-300, point.to * -0x1p-300};
    expect_meeting(query, time);
    for (MovingPoint& point : p) point = {point.from * 0x1p700, point.to * 0x1p700};
    expect_meeting(query, time);
  }
}

INSTANTIATE_TEST_SUITE_P(Coordinates, MeetingsOf,
                         testing::Values(Sample{"SmallIntegers", small_integer, 500}, Sample{"AnyReals", any_real, 100},
                                         Sample{"OffByOneDigit", off_by_one_digit, 100},
                                         Sample{"OfAnyMagnitude", of_any_magnitude, 30}),
                         [](const auto& sample) { return sample.param.name; });

/// Points that are at known places at a known time. All sums and products below are exact in double.
class ConstructedMeetings : public testing::Test {
 protected:
  double whole(int range) { return static_cast<double>(random_() % static_cast<unsigned>(2 * range + 1)) - range; }
  glm::dvec3 vector(int range) { return {whole(range), whole(range), whole(range)}; }
  /// Returns a point that moves through `place` at that time.
  MovingPoint through(const glm::dvec3& place, double time) {
    const glm::dvec3 velocity = vector(8);
    return {place - velocity * time, place + velocity * (1 - time)};
  }
  double quarter() { return static_cast<double>(random_() % 5) / 4; }

  std::mt19937_64 random_{51};
};

TEST_F(ConstructedMeetings, AreFound) {
  for (int i = 0; i < 20000; ++i) {
    const double time = static_cast<double>(random_() % 9) / 8, s = quarter(), r = quarter();
    const glm::dvec3 a = vector(4), b = vector(4), c = vector(4);
    // On the face: on the line from a to a point of the side bc.
    const Query vertex_face{
        Kind::vertex_face,
        {through(a + ((b - a) + (c - b) * s) * r, time), through(a, time), through(b, time), through(c, time)}};
    // The second edge ends at b, and r of it lies on the other side of a point of the first edge.
    const glm::dvec3 point = a * (1 - s) + c * s;
    const Query edge_edge{Kind::edge_edge,
                          {through(a, time), through(c, time), through(point + b, time), through(point - b * r, time)}};
    for (const Query& query : {vertex_face, edge_edge}) {
      const std::optional<Meeting> meeting = meeting_of(query);
      ASSERT_TRUE(meeting) << text_of(query);
      ASSERT_LE(meeting->low, time) << text_of(query);
    }
  }
}

/// A vertex passes the plane of a face beside one of its sides, or an edge passes another beside its end, by any
/// little.
TEST_F(ConstructedMeetings, AreToldFromNearMissesBesideASide) {
  int found = 0;
  for (int i = 0; i < 4000; ++i) {
    const double gap = std::ldexp(i % 2 == 0 ? 1 : -1, -static_cast<int>(random_() % 200));
    // The side, or the end, is at x = 0 all the time; the other feature comes across it in y and z only.
    const auto moving = [&](double x, double y, double z, double by) {
      return MovingPoint{{x, y + whole(1) / 8, z + whole(1) / 8}, {x, y + whole(1) / 8, z + by + whole(1) / 8}};
    };
    const Query vertex_face{Kind::vertex_face,
                            {moving(gap, 0, 1, -2), moving(0, -8, 0, 0), moving(0, 8, 0, 0), moving(-8, 0, 0, 0)}};
    const Query edge_edge{Kind::edge_edge,
                          {moving(gap, -2, 1, -2), moving(gap, 2, 1, -2), moving(0, 0, 0, 0), moving(-8, 0, 0, 0)}};
    for (const Query& query : {vertex_face, edge_edge}) {
      ASSERT_EQ(meeting_of(query).has_value(), gap <= 0) << text_of(query);
      ASSERT_EQ(passage_of(query).has_value(), gap <= 0) << text_of(query);
      if (i % 40 == 1) expect_meeting(query, truth_of(query).first_meeting);
      found += gap <= 0;
    }
  }
  EXPECT_EQ(found, 4000);
}

/// A plane that moves separates the features by a tiny gap, and their boxes overlap.
TEST_F(ConstructedMeetings, AreNoneBesideAMovingPlane) {
  const double gap = 0x1p-40;
  for (int i = 0; i < 20000; ++i) {
    for (const Kind kind : {Kind::vertex_face, Kind::edge_edge}) {
      const glm::dvec3 from = vector(2), to = vector(2);
      Query query{kind, {}};
      for (std::size_t k = 0; k < 4; ++k) {
        const bool first = k < (kind == Kind::vertex_face ? 1u : 2u);
        const auto place = [&](const glm::dvec3& origin) {
          const double x = first ? gap + std::max(0.0, whole(2)) : -std::max(0.0, whole(2)), y = whole(4), z = whole(4);
          // Shears the plane x = 0.
          return glm::dvec3(x + 2 * y - z, y, z + 2 * x) + origin;
        };
        query.points[k] = {place(from), place(to)};
      }
      ASSERT_FALSE(meeting_of(query)) << text_of(query);
      ASSERT_FALSE(passage_of(query)) << text_of(query);
    }
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
