// The contacts of many threads in rows, against std::sort.

#include "collide/exact/contact_rows.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "states.h"

namespace collide::test {
namespace THIS_FILE {

/// Contacts of the vertices of two runs, with other contacts in front of, between and behind them.
TEST(ContactRows, SortWhatThreadsFoundInNoOrder) {
  std::mt19937 random(91);
  exact::ContactRows rows;
  for (const int threads : {1, 2, 5}) {
    for (const Index most : {0u, 3u, 60u, 400u}) {  // contacts of a vertex
      const Index vertices = 1'000;
      const std::array<Range, 2> runs{Range{10, 200}, Range{300, 700}};
      std::vector<Contact> all;
      std::array<std::size_t, 2> sizes{};
      for (std::size_t k = 0; k < 2; ++k) {
        for (Index a = runs[k].begin; a < runs[k].end; ++a) {
          const Index count = most == 0 || random() % 4 == 0 ? 0 : random() % most;
          for (Index b = a + 1; b < vertices; ++b) {
            if (random() % (vertices - a) < count) all.push_back({a, b}), ++sizes[k];
          }
        }
      }
      const std::vector<Contact> expected = all;
      std::shuffle(all.begin(), all.end(), random);
      const std::array<std::size_t, 3> gaps{5, 7, 9};
      std::vector<Contact> placed(gaps[0] + sizes[0] + gaps[1] + sizes[1] + gaps[2], Contact{1, 2});
      Workers workers(threads, 0);
      const auto part = [&](int thread) {
        const Part own = part_of(all.size(), thread, threads);
        return std::span(all).subspan(own.begin, own.end - own.begin);
      };
      rows.begin(vertices, threads);
      workers.run(threads, [&](int thread) { rows.count(thread, part(thread)); });
      const std::size_t end = rows.place(runs[0], gaps[0]);
      EXPECT_EQ(end, gaps[0] + sizes[0]);
      EXPECT_EQ(rows.place(runs[1], end + gaps[1]), end + gaps[1] + sizes[1]);
      workers.run(threads, [&](int thread) { rows.scatter(thread, part(thread), placed); });
      workers.run(threads, [&](int thread) { rows.sort(thread, placed); });
      const auto at = [&](std::size_t place) { return placed.begin() + static_cast<std::ptrdiff_t>(place); };
      std::vector<Contact> found(at(gaps[0]), at(end));
      found.insert(found.end(), at(end + gaps[1]), at(end + gaps[1] + sizes[1]));
      EXPECT_EQ(found, expected) << threads << ' ' << most;
      placed.erase(at(end + gaps[1]), at(end + gaps[1] + sizes[1]));
      placed.erase(at(gaps[0]), at(end));
      EXPECT_EQ(placed, std::vector<Contact>(gaps[0] + gaps[1] + gaps[2], Contact{1, 2}));
    }
  }
}

}  // namespace THIS_FILE
}  // namespace collide::test
