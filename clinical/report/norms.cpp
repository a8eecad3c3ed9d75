#include "clinical/report/norms.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/file.h"
#include "core/strict_json.h"

namespace sinew {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double Norm::zScore(double value) const {
  return comparable && sd > 0 ? (value - mean) / sd : kNaN;
}

bool NormTable::Entry::fits(const NormQuery& who) const {
  if (!sex.empty() && sex != who.sex) return false;
  if (share_of_height && !who.height_m) return false;
  const bool any_age = age_min_y <= 0 && age_max_y >= 200 && by_age.size() <= 1;
  if (any_age) return true;
  return who.age_y && *who.age_y >= age_min_y && *who.age_y < age_max_y;
}

Norm NormTable::Entry::at(const NormQuery& who) const {
  Norm result = norm;
  if (share_of_height) {
    result.mean = 1000 * *share_of_height * *who.height_m;
    return result;
  }
  const double age_y = who.age_y.value_or(by_age.front().age_y);
  const auto above = std::ranges::find_if(by_age, [&](const AgePoint& p) { return p.age_y > age_y; });
  const AgePoint& a = above == by_age.begin() ? by_age.front() : *(above - 1);
  const AgePoint& b = above == by_age.end() ? by_age.back() : *above;
  const double t = b.age_y > a.age_y ? (age_y - a.age_y) / (b.age_y - a.age_y) : 0;
  result.mean = a.mean + t * (b.mean - a.mean);
  result.sd = t > 0 ? a.sd + t * (b.sd - a.sd) : a.sd;
  return result;
}

std::string headingOf(const FigureText& text) {
  return text.convention.empty() ? text.title : text.title + " (" + text.convention + ")";
}

FigureText NormTable::textOf(std::string_view quantity) const {
  for (const auto& figure : figures_)
    if (figure.text.quantity == quantity) return figure.text;
  FigureText text{std::string{quantity}, std::string{quantity}, "", ""};
  std::ranges::replace(text.title, '_', ' ');
  return text;
}

std::optional<Norm> NormTable::normOf(std::string_view quantity, const NormQuery& who) const {
  for (const auto& figure : figures_)
    if (figure.text.quantity == quantity)
      for (const auto& entry : figure.entries)
        if (entry.fits(who)) return entry.at(who);
  return std::nullopt;
}

NormTable loadNorms(const std::filesystem::path& resource_dir) {
  const auto file = resource_dir / "clinical" / "norms.json";
  const Json document = parseJson(readFile(file), file.string());
  const JsonReader root{document, file.string()};
  root.expectFormat("sinew.norms", 1);
  root.allowOnly({"format", "version", "about", "figures"});
  NormTable table;
  for (const auto& f : root["figures"].items()) {
    f.allowOnly({"quantity", "title", "unit", "convention", "definition", "norms"});
    NormTable::Figure figure{
        {f["quantity"].text(), f["title"].text(), f["convention"].text(), f["definition"].text()}, {}};
    const std::string unit = f["unit"].oneOf({"mm", "deg"});
    for (const auto& n : f["norms"].items()) {
      n.allowOnly(
          {"sex", "age_y", "share_of_height", "by_age_y_mean_sd", "source", "verified", "same_definition", "note"});
      NormTable::Entry entry;
      if (const auto sex = n.find("sex")) entry.sex = sex->oneOf({"F", "M"});
      if (const auto range = n.find("age_y")) {
        const auto age = range->numbers(2);
        if (!(age[0] < age[1])) range->fail("lower < upper");
        entry.age_min_y = age[0];
        entry.age_max_y = age[1];
      }
      if (const auto share = n.find("share_of_height")) {
        if (unit != "mm") share->fail("only for lengths");
        entry.share_of_height = share->numberIn(0, 1);
      } else {
        for (const auto& point : n["by_age_y_mean_sd"].items()) {
          const auto three = point.items(3);
          entry.by_age.push_back({three[0].number(), three[1].number(), three[2].numberOrNaN()});
          const auto count = entry.by_age.size();
          if (count > 1 && !(entry.by_age[count - 2].age_y < entry.by_age[count - 1].age_y))
            point.fail("rising ages");
        }
        if (entry.by_age.empty()) n.fail("at least one [age, mean, SD]");
      }
      entry.norm.source = n["source"].text();
      entry.norm.verified = n["verified"].boolean();
      entry.norm.comparable = n["same_definition"].boolean();
      if (const auto note = n.find("note")) entry.norm.note = note->text();
      figure.entries.push_back(std::move(entry));
    }
    table.figures_.push_back(std::move(figure));
  }
  return table;
}

}  // namespace sinew
