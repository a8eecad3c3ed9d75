#pragma once
#include <source_location>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// A file or a person supplied something that cannot be used. The message is one line and can be acted on.
class InputError : public std::runtime_error {
 public:
  struct Detail {
    std::string where;     ///< file, form or option
    std::string field;     ///< which entry of it; may be empty
    std::string expected;  ///< what would have been accepted; may be empty
    std::string found;     ///< what was there; may be empty
  };
  explicit InputError(const std::string& message);
  /// Message reads "where: field: expected ..., found ...".
  explicit InputError(Detail detail);

  const Detail& detail() const { return detail_; }

 private:
  Detail detail_;
};

/// A doubt that does not stop the work; collected in results and shown to the clinician.
struct Warning {
  std::string code;  ///< stable identifier, e.g. "pixel_spacing_missing"
  std::string message;
  friend bool operator==(const Warning&, const Warning&) = default;
};
using Warnings = std::vector<Warning>;

/// Guards against bugs of the caller. Always on. @throws std::logic_error with the place of the call.
void require(bool condition, std::string_view what, std::source_location where = std::source_location::current());

}  // namespace sinew
