#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Splits one line of comma-separated values; double quotes protect commas, "" is a quote. Blanks around a cell
/// go, and so does the byte order mark that spreadsheets put before the first line.
std::vector<std::string> splitCsvLine(std::string_view line);

/// The `count` known names most like `name` (edit distance), nearest first: to answer a wrong name.
std::vector<std::string> nearestNames(std::string_view name, std::span<const std::string> known,
                                      std::size_t count = 3);

/// Ends an error message about a wrong name: "; nearest: a, b, c" or nothing if `known` is empty.
std::string didYouMean(std::string_view name, std::span<const std::string> known);

// The one way numbers become words, with a point whatever the user's locale says. Longer texts: fmt.

/// A number with so many decimals; never "-0"; "-" if it is not finite.
std::string fixed(double value, int decimals);
/// A number with at most so many significant digits and no zeros behind them.
std::string brief(double value, int digits = 6);

/// @throws InputError naming `where` and `field` if `text` is not one finite number.
double parseNumber(std::string_view text, const std::string& where, const std::string& field);

}  // namespace sinew
