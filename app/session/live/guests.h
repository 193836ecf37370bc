#pragma once
// The methods of the user's own in the window: loaded beside it, and again whenever their files change.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/background.h"
#include "app/guest/guest.h"

namespace app::session {

class Guests {
 public:
  Guests() = default;
  /// Ends what they run.
  ~Guests();

  void add(std::shared_ptr<guest::Guest> guest) { guests_.push_back(std::move(guest)); }
  /// Takes the guests from files that were dropped on the window, and returns the others. The user must answer first.
  std::vector<std::string> take_from(std::vector<std::string> dropped);
  /// Returns true while message() asks whether to run what was dropped.
  bool asks() const { return !dropped_.empty(); }
  void answer(bool run);

  /// Begins to load a file that has changed, and takes what was loaded. Call it once a picture. Returns the method that
  /// is another one now, an index in the table, if one is.
  std::optional<std::size_t> update();
  bool loading() const { return loading_ != nullptr; }
  /// Returns a question, what is being loaded, or what is wrong with the files, with all errors of the compiler; empty
  /// if there is nothing to say.
  std::string message() const;
  /// Puts away what is wrong, until a file changes.
  void dismiss() { dismissed_ = true; }

 private:
  std::vector<std::string> dropped_;
  std::vector<std::shared_ptr<guest::Guest>> guests_;
  std::shared_ptr<guest::Guest> loading_;
  bool dismissed_ = false;
  Background<Call> loader_;
};

}  // namespace app::session
