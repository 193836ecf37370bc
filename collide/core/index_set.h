#pragma once
// A set of small numbers as a two-level bit set: one bit for each number, and one bit for each word that is not 0. It
// is filled without branches and read as runs, and few members among many numbers are found quickly.

#include <bit>
#include <utility>

#include "collide/core/points.h"

namespace collide {

class IndexSet {
 public:
  using Word = std::uint64_t;
  static constexpr Index word_size = 64;

  /// Empties the set and makes room for the numbers below count.
  void reset(Index count) {
    words_.assign((count + std::size_t{word_size} - 1) / word_size, 0);
    used_.assign((words_.size() + word_size - 1) / word_size, 0);
  }

  /// Adds word_size * word + k for every bit k of bits.
  void add(Index word, Word bits) {
    words_[word] |= bits;
    used_[word / word_size] |= Word{1} << word % word_size;
  }

  /// Adds one number.
  void add(Index number) { add(number / word_size, Word{1} << number % word_size); }

  /// Empties the set and calls take(run) for every maximal run of consecutive members; ascending. Precondition: no
  /// member is below `least`.
  template <class Take>
  void take_runs(Index least, const Take& take) {
    Range run{0, 0};
    for (std::size_t group = least / (word_size * word_size); group < used_.size(); ++group) {
      for (Word used = std::exchange(used_[group], 0); used != 0; used &= used - 1) {
        const auto word = static_cast<Index>(group * word_size) + static_cast<Index>(std::countr_zero(used));
        for (Word bits = std::exchange(words_[word], 0); bits != 0; bits &= bits + (bits & -bits)) {
          const int begin = std::countr_zero(bits);
          const Index first = word * word_size + static_cast<Index>(begin);
          if (first != run.end) {
            if (run.size() > 0) take(run);
            run.begin = first;
          }
          run.end = first + static_cast<Index>(std::countr_one(bits >> begin));
        }
      }
    }
    if (run.size() > 0) take(run);
  }

 private:
  std::vector<Word> words_, used_;
};

}  // namespace collide
