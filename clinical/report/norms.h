#pragma once
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clinical/case/age.h"

namespace sinew {

/// Whom a norm is asked for. What is unknown is left out; norms that need it are then not given.
struct NormQuery {
  std::string sex;  ///< "F", "M" or anything else = unknown
  std::optional<double> age_y, height_m;
};

/// A normal value. Angles [deg] and lengths [mm] as in the figure it belongs to.
struct Norm {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double sd = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the source gives none
  std::string source;
  std::string note;
  bool verified = false;   ///< the figures were read in the source itself
  bool comparable = true;  ///< measured by our definition; if not, no z-score
  /// Standard deviations from the mean; NaN if there is no SD or the definition is another.
  double zScore(double value) const;
};

/// A quantity of the report: what it is called, how it is defined, whom it is normal for.
struct FigureText {
  std::string quantity;    ///< BoneFigure::quantity
  std::string title;       ///< "Femoral torsion"
  std::string convention;  ///< sign in a few words: "anteversion +"
  std::string definition;
};

/// "Hip-knee-ankle angle (varus +, 0 = straight)": how report and window head a figure.
std::string headingOf(const FigureText& text);

class NormTable {
 public:
  /// Title and definition; a quantity that the file does not know is called by its name.
  FigureText textOf(std::string_view quantity) const;
  /// The first norm of the quantity whose age and sex fit and whose needs (height, age) are known.
  std::optional<Norm> normOf(std::string_view quantity, const NormQuery& who) const;

 private:
  friend NormTable loadNorms(const std::filesystem::path& resource_dir);
  struct AgePoint {
    double age_y, mean, sd;
  };
  struct Entry {
    std::string sex;  ///< empty: both
    double age_min_y = 0, age_max_y = 200;
    std::optional<double> share_of_height;  ///< mean = share * height
    std::vector<AgePoint> by_age;           ///< rising ages; linear between; one point: constant
    Norm norm;                              ///< source and flags; mean and SD from the above
    bool fits(const NormQuery& who) const;
    Norm at(const NormQuery& who) const;
  };
  struct Figure {
    FigureText text;
    std::vector<Entry> entries;
  };
  std::vector<Figure> figures_;
};

/// Reads clinical/norms.json ("sinew.norms", version 1). @throws InputError: file, field, expected, found.
NormTable loadNorms(const std::filesystem::path& resource_dir);

}  // namespace sinew
