// Whether moving features meet and pass, against queries whose truth is known: from the public benchmark, by
// construction, and by rational arithmetic written apart.

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

void expect_passage(const Query& query, const std::optional<Passage>& expected) {
  const std::optional<Passage> passage = passage_of(query);
  ASSERT_EQ(passage.has_value(), expected.has_value()) << text_of(query);
  if (!passage) return;
  EXPECT_NEAR(passage->time, expected->time, 1e-12) << text_of(query);
  EXPECT_EQ(passage->inward, expected->inward) << text_of(query);
}

TEST(MeetingOf, AnswersThePublicQueriesRightly) {
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

TEST(MeetingOf, CountsTheFirstAndTheLastInstant) {
  const glm::dvec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0), above(1, 1, 1), on(1, 1, 0);
  const auto query = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return Query{Kind::vertex_face, {{{from, to}, {a, a}, {b, b}, {c, c}}}};
  };
  expect_meeting(query(above, on), 1);
  expect_meeting(query(on, above), 0);
  expect_meeting(query(above, above + glm::dvec3(0, 0, std::nextafter(-1, 0))), std::nullopt);
  expect_meeting(query(above, {1, 1, std::numeric_limits<double>::denorm_min()}), std::nullopt);
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

class RandomQueries : public testing::TestWithParam<Sample> {};

/// In any unit.
TEST_P(RandomQueries, AreAnsweredAsByRationalArithmetic) {
  std::mt19937_64 random(49);
  int met = 0, passed = 0;
  for (int i = 0; i < GetParam().count; ++i) {
    Query query = random_query(random, GetParam().coordinate);
    degenerate(query, random);
    const Truth truth = truth_of(query);
    expect_meeting(query, truth.first_meeting);
    expect_passage(query, truth.first_passage);
    for (const double unit : {0x1p-300, 0x1p700}) {
      for (MovingPoint& point : query.points) point = {point.from * unit, point.to * unit};
      expect_meeting(query, truth.first_meeting);
      expect_passage(query, truth.first_passage);
    }
    met += truth.first_meeting.has_value();
    passed += truth.first_passage.has_value();
  }
  EXPECT_GT(met, GetParam().count / 10);
  EXPECT_GT(passed, 0);
}

INSTANTIATE_TEST_SUITE_P(Coordinates, RandomQueries,
                         testing::Values(Sample{"SmallIntegers", small_integer, 500}, Sample{"AnyReals", any_real, 100},
                                         Sample{"OffByOneDigit", off_by_one_digit, 100},
                                         Sample{"OfAnyMagnitude", of_any_magnitude, 30}),
                         [](const auto& sample) { return sample.param.name; });

/// The points begin exactly in one plane, but no double holds the products of three differences of their coordinates.
TEST(PassageOf, KnowsTheSideOfPointsThatBeginInOnePlane) {
  std::mt19937_64 random(52);
  const auto rounded = [&] { return std::round(any_real(random) * 0x1p20) * 0x1p-20; };
  for (int i = 0; i < 300; ++i) {
    Query query{i % 2 == 0 ? Kind::vertex_face : Kind::edge_edge, {}};
    for (MovingPoint& p : query.points) {
      const double x = rounded(), z = rounded();
      p = {{x, x + z, z}, {x, x + z + any_of(random, {-0.5, 0, 0.5}), z}};
    }
    expect_passage(query, truth_of(query).first_passage);
  }
}

/// A vertex passes the plane of a face beside one of its sides, or an edge passes another beside its end, by any
/// little.
TEST(MeetingOf, TellsMeetingsFromNearMisses) {
  std::mt19937_64 random(51);
  const auto jitter = [&] { return (static_cast<double>(random() % 3) - 1) / 8; };
  int found = 0;
  for (int i = 0; i < 4000; ++i) {
    const double gap = std::ldexp(i % 2 == 0 ? 1 : -1, -static_cast<int>(random() % 200));
    // The side, or the end, is at x = 0 all the time; the other feature comes across it in y and z only.
    const auto moving = [&](double x, double y, double z, double by) {
      return MovingPoint{{x, y + jitter(), z + jitter()}, {x, y + jitter(), z + by + jitter()}};
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

}  // namespace THIS_FILE
}  // namespace collide::test
