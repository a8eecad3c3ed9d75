#include "core/error.h"

namespace sinew {
namespace {

std::string messageOf(const InputError::Detail& detail) {
  std::string message = detail.where;
  if (!detail.field.empty()) message += (message.empty() ? "" : ": ") + detail.field;
  if (!detail.expected.empty()) message += (message.empty() ? "expected " : ": expected ") + detail.expected;
  if (!detail.found.empty()) message += (message.empty() ? "found " : ", found ") + detail.found;
  return message;
}

}  // namespace

InputError::InputError(const std::string& message) : std::runtime_error{message} {}

InputError::InputError(Detail detail) : std::runtime_error{messageOf(detail)}, detail_{std::move(detail)} {}

void require(bool condition, std::string_view what, std::source_location where) {
  if (condition) return;
  throw std::logic_error{std::string{where.file_name()} + ":" + std::to_string(where.line()) + ": " +
                         std::string{what}};
}

}  // namespace sinew
