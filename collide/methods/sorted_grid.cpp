// A uniform grid by counting sort, as particle codes have it: each vertex goes into a cell of the tolerance's size, the
// vertices are sorted by cell, and a vertex is tested against those of its own and of the adjacent cells. The grid is
// rolled up like a torus of two to four vertices a cell, so that it stays small wherever the bodies are, and few cells
// are empty; cells that coincide cost tests, but no contact.
// Memory: 28 bytes a vertex, and what CountingSort takes.

#include <algorithm>

#include "collide/core/body_boxes.h"
#include "collide/core/contact_search.h"
#include "collide/core/counting_sort.h"
#include "collide/core/cutoff.h"
#include "collide/methods/detectors.h"

namespace collide::methods {

namespace {

/// A grid of 2^bits cells along each axis that repeats itself.
///
/// The cells of two vertices in contact are equal or adjacent along each axis: Let c be the cutoff, s = c (1 + 2^-20)
/// the side of a cell. If two coordinates differ, by c at most, both are floats below 2^25 c, so both quotients by s
/// are below 2^25. They differ by less than 1 - 2^-21, and each errs by less than 2^-26.
class TorusGrid {
 public:
  TorusGrid(const Frame& frame, const VertexList& vertices, float cutoff) : inverse_(1 / (cutoff * (1 + 0x1p-20))) {
    std::array<double, 3> cells_left = spread(frame, vertices);  // along each axis, in units of the cells that it has
    for (double& cells : cells_left) cells *= inverse_ / 4;
    const Index enough = vertices.size() / 4;  // with more, half of the cells are empty: mispredicted branches
    for (int used = 6; used < 30 && (Index{1} << used) < enough; ++used) {
      const auto longest = static_cast<std::size_t>(std::ranges::max_element(cells_left) - cells_left.begin());
      if (cells_left[longest] <= 1) break;
      cells_left[longest] /= 2;
      ++bits_[longest];
    }
  }

  Index width() const { return Index{1} << bits_[0]; }
  /// The rows of cells along x: by y, then z.
  Index rows() const { return Index{1} << (bits_[1] + bits_[2]); }
  Index cells() const { return width() * rows(); }

  Index cell(float x, float y, float z) const {
    return wrapped(0, index(x)) | (wrapped(1, index(y)) | wrapped(2, index(z)) << bits_[1]) << bits_[0];
  }
  /// Returns the row that lies dy rows along y and dz along z from another one. dy, dz: -1 to 1.
  Index row_beside(Index row, int dy, int dz) const {
    const std::int64_t y = wrapped(1, row), z = row >> bits_[1];
    return wrapped(1, y + dy) | wrapped(2, z + dz) << bits_[1];
  }

 private:
  /// Returns how far (m) the vertices are spread along each axis: twice the distance between the quartiles of a sample.
  /// So a few bodies far away take no cells from a pile.
  static std::array<double, 3> spread(const Frame& frame, const VertexList& vertices) {
    constexpr std::size_t sample_size = 256;
    std::array<std::array<float, sample_size>, 3> sample;
    if (vertices.size() == 0) return {};
    for (std::size_t k = 0; k < sample_size; ++k) {
      // Multiples of the golden section, modulo 1: evenly spread, and out of step with the order of any mesh.
      const std::size_t number = (k * std::uint64_t{0x9E3779B9} % (std::uint64_t{1} << 32)) * vertices.size() >> 32;
      vertices.for_each({number, number + 1}, [&](Index, Index vertex, Index) {
        sample[0][k] = frame.x[vertex], sample[1][k] = frame.y[vertex], sample[2][k] = frame.z[vertex];
      });
    }
    std::array<double, 3> spread{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::ranges::sort(sample[axis]);
      spread[axis] = 2 * (double{sample[axis][sample_size * 3 / 4]} - double{sample[axis][sample_size / 4]});
    }
    return spread;
  }
  std::int64_t index(float value) const {
    constexpr double limit = 0x1p62;
    const double quotient = std::clamp(value * inverse_, -limit, limit);
    const auto truncated = static_cast<std::int64_t>(quotient);
    return truncated - (static_cast<double>(truncated) > quotient ? 1 : 0);
  }
  Index wrapped(std::size_t axis, std::int64_t index) const {
    return static_cast<Index>(index) & ((Index{1} << bits_[axis]) - 1);
  }

  double inverse_;                    // 1/m, of the side of a cell
  std::array<int, 3> bits_{2, 2, 2};  // with less, a cell would meet a neighbour twice
};

class SortedGrid final : public Detector {
 public:
  void detect(const Frame& frame, const Settings& settings, Workers& workers, Result& result) override {
    bodies_.build(frame, result);
    const VertexList vertices(*frame.bodies, bodies_.live);
    const TorusGrid grid(frame, vertices, contact_cutoff(settings.tolerance));
    sort_vertices(frame, vertices, grid, workers);
    const int parts = workers.threads_for(test_ns * vertices.size());
    search_.begin(frame, settings, points_, parts);
    workers.run(parts, [&](int part) {
      const Part rows = part_of(grid.rows(), part, parts);
      for (auto row = static_cast<Index>(rows.begin); row < rows.end; ++row) test_row(part, grid, row);
    });
    search_.finish(result);
  }

 private:
  static constexpr double move_ns = 5, test_ns = 25;  // of work, of a vertex

  void sort_vertices(const Frame& frame, const VertexList& vertices, const TorusGrid& grid, Workers& workers) {
    cell_.resize(vertices.size());
    const int parts = workers.threads_for(move_ns * vertices.size());
    workers.run(parts, [&](int part) {
      vertices.for_each(part_of(vertices.size(), part, parts), [&](Index k, Index vertex, Index) {
        cell_[k] = grid.cell(frame.x[vertex], frame.y[vertex], frame.z[vertex]);
      });
    });
    sort_.sort(cell_, grid.cells(), workers);
    points_.resize(vertices.size());
    workers.run(parts, [&](int part) {
      vertices.for_each(part_of(vertices.size(), part, parts),
                        [&](Index k, Index vertex, Index body) { points_.set(sort_.slot(k), frame, vertex, body); });
    });
  }

  /// Tests the vertices of a row of cells among themselves and against those of the four rows that come next. The row's
  /// other four neighbours test theirs against this one.
  void test_row(int thread, const TorusGrid& grid, Index row) {
    const Index width = grid.width();
    const std::span<const Index> begin = sort_.begins().subspan(std::size_t{row} * width, width + std::size_t{1});
    if (begin.front() == begin.back()) return;
    const std::array beside{grid.row_beside(row, 1, 0), grid.row_beside(row, -1, 1), grid.row_beside(row, 0, 1),
                            grid.row_beside(row, 1, 1)};
    std::array<Range, 9> runs;  // one of this row, and up to two of each of the four
    for (Index x = 0; x < width; ++x) {
      const Range own{begin[x], begin[x + 1]};
      if (own.size() == 0) continue;
      if (own.size() > 1) search_.test(thread, own, own);
      std::size_t count = 0;
      const auto add = [&](Range run) {
        if (run.size() > 0) runs[count++] = run;
      };
      add(sort_.slots(row * width + (x + 1) % width));
      for (const Index other : beside) {
        const Index* const cells = &sort_.begins()[std::size_t{other} * width];
        add({cells[x == 0 ? 0 : x - 1], cells[std::min(x + 2, width)]});
        if (x == 0) add({cells[width - 1], cells[width]});
        if (x + 1 == width) add({cells[0], cells[1]});
      }
      search_.test(thread, own, std::span(runs).first(count));
    }
  }

  BodyBoxes bodies_;
  std::vector<Index> cell_;  // of each vertex in turn
  CountingSort sort_;
  Points points_;  // cell by cell
  ContactSearch search_;
};

}  // namespace

std::unique_ptr<Detector> make_sorted_grid() { return std::make_unique<SortedGrid>(); }

}  // namespace collide::methods
