#include <algorithm>
#include <cmath>

#include "core/file.h"
#include "core/model/rom_preset.h"
#include "core/rom/tests/clinical_tests.h"
#include "core/strict_json.h"

namespace sinew {
namespace {

std::map<std::string, double> coordinatesFrom(const JsonReader& json, std::string_view member,
                                              const Skeleton* skeleton, double limit) {
  std::map<std::string, double> values;
  if (const auto object = json.find(member))
    for (const auto& [name, value] : object->members()) {
      try {
        if (skeleton) sidedCoordinate(*skeleton, name, 'r');
      } catch (const InputError& error) {
        throw InputError{value.where() + ": " + value.path() + ": " + error.what()};
      }
      values[name] = value.numberIn(-limit, limit);
    }
  return values;
}

/// {"average-adult": {"mean": 74, "sd": 9, "accept": [60, 95]}, "athlete": {"accept": [130, 160]}}.
std::map<std::string, TestNorm, std::less<>> presetNorms(const JsonReader& json, const std::string& source) {
  std::map<std::string, TestNorm, std::less<>> norms;
  for (const auto& [preset, entry] : json.members()) {
    entry.allowOnly({"mean", "sd", "accept"});
    TestNorm norm;
    if (const auto mean = entry.find("mean")) norm.mean_deg = mean->number();
    if (const auto sd = entry.find("sd")) norm.sd_deg = sd->positive();
    const auto range = entry["accept"].numbers(2);
    if (range[0] > range[1]) entry["accept"].fail("lower, upper");
    norm.accept_min_deg = range[0], norm.accept_max_deg = range[1];
    norm.source = source;
    norms[preset] = norm;
  }
  return norms;
}

AgeNorm ageNormFrom(const JsonReader& json) {
  json.allowOnly({"age_y", "sex", "mean", "sd", "source", "verified"});
  AgeNorm n;
  const auto age = json["age_y"].numbers(2);
  if (!(age[0] < age[1])) json["age_y"].fail("lower < upper");
  n.from_y = age[0], n.to_y = age[1];
  if (const auto sex = json.find("sex")) n.sex = sex->oneOf({"F", "M"});
  n.norm.mean_deg = json["mean"].number();
  n.norm.sd_deg = json["sd"].positive();
  n.norm.accept_min_deg = n.norm.mean_deg - 2 * n.norm.sd_deg;
  n.norm.accept_max_deg = n.norm.mean_deg + 2 * n.norm.sd_deg;
  n.norm.source = json["source"].text();
  n.norm.verified = json["verified"].boolean();
  return n;
}

FormRow formFrom(const JsonReader& json) {
  json.allowOnly({"protocol", "convention", "scale", "offset_deg", "entry_deg", "doubt_deg", "measurement_sd_deg",
                  "measurement_sd_source", "groups"});
  FormRow form;
  form.protocol = json["protocol"].text();
  form.convention = json["convention"].text();
  if (const auto scale = json.find("scale")) form.scale = scale->integer(-1, 1);
  if (form.scale == 0) json["scale"].fail("1 or -1");
  if (const auto offset = json.find("offset_deg")) form.offset_deg = offset->numberIn(-180, 180);
  const auto entry = json["entry_deg"].numbers(2), doubt = json["doubt_deg"].numbers(2);
  if (!(entry[0] < entry[1])) json["entry_deg"].fail("lower < upper");
  if (!(doubt[0] < doubt[1])) json["doubt_deg"].fail("lower < upper");
  form.entry_min_deg = entry[0], form.entry_max_deg = entry[1];
  form.doubt_min_deg = doubt[0], form.doubt_max_deg = doubt[1];
  form.measurement_sd_deg = json["measurement_sd_deg"].positive();
  form.measurement_sd_source = json["measurement_sd_source"].text();
  for (const auto& group : json["groups"].items()) form.groups.push_back(group.text());
  return form;
}

ClinicalTest testFrom(const JsonReader& json, const Skeleton* skeleton) {
  json.allowOnly({"id", "title", "aliases", "posture_deg", "contralateral_deg", "moves", "reads", "read_offset_deg",
                  "from_deg", "to_deg", "threshold_Nm", "norms", "norms_by_age", "limited_by", "source", "confidence",
                  "form"});
  ClinicalTest test;
  test.id = json["id"].text();
  test.title = json["title"].text();
  if (const auto aliases = json.find("aliases"))
    for (const auto& alias : aliases->items()) test.aliases.push_back(alias.text());
  test.posture_deg = coordinatesFrom(json, "posture_deg", skeleton, 180);
  test.contralateral_deg = coordinatesFrom(json, "contralateral_deg", skeleton, 180);
  test.moves = coordinatesFrom(json, "moves", skeleton, 10);
  if (test.moves.empty()) json["moves"].fail("at least one coordinate");
  test.reads = coordinatesFrom(json, "reads", skeleton, 10);
  if (test.reads.empty())
    for (const auto& [name, share] : test.moves) test.reads[name] = 1;
  if (const auto offset = json.find("read_offset_deg")) test.read_offset_deg = offset->numberIn(-180, 180);
  test.from_deg = json["from_deg"].numberIn(-360, 360);
  test.to_deg = json["to_deg"].numberIn(-360, 360);
  if (test.from_deg == test.to_deg) json["to_deg"].fail("another angle than from_deg");
  test.threshold_Nm = json["threshold_Nm"].positive();
  test.limited_by = json["limited_by"].text();
  test.source = json["source"].text();
  test.confidence = json["confidence"].oneOf({"A", "B", "C"});
  test.norms = presetNorms(json["norms"], test.source);
  if (const auto norms = json.find("norms_by_age"))
    for (const auto& norm : norms->items()) test.norms_by_age.push_back(ageNormFrom(norm));
  if (const auto form = json.find("form")) test.form = formFrom(*form);
  return test;
}

TestCoupling couplingFrom(const JsonReader& json, const ClinicalTests& tests) {
  json.allowOnly({"id", "title", "first", "second", "sign", "must_be_positive", "norms", "source"});
  TestCoupling c{json["id"].text(), json["title"].text(), json["first"].text(), json["second"].text()};
  tests.test(c.first);
  tests.test(c.second);
  if (const auto sign = json.find("sign")) c.sign = sign->integer(-1, 1);
  c.must_be_positive = json["must_be_positive"].boolean();
  c.source = json["source"].text();
  c.norms = presetNorms(json["norms"], c.source);
  return c;
}

TestContradiction contradictionFrom(const JsonReader& json, const ClinicalTests& tests) {
  json.allowOnly({"first", "second", "sum", "least_deg", "most_deg", "text"});
  TestContradiction c{.first = json["first"].text(), .second = json["second"].text(), .text = json["text"].text()};
  if (!tests.test(c.first).form) json["first"].fail("a test of the form");
  if (!tests.test(c.second).form) json["second"].fail("a test of the form");
  if (const auto sum = json.find("sum")) c.sum = sum->boolean();
  if (const auto least = json.find("least_deg")) c.least_deg = least->number();
  if (const auto most = json.find("most_deg")) c.most_deg = most->number();
  return c;
}

void addTests(const JsonReader& root, const Skeleton* skeleton, ClinicalTests& all) {
  const double band = root["threshold_band"].numberIn(0, 1);
  root["threshold_band_source"].text();
  root["reference_mass_source"].text();
  for (const auto& json : root["tests"].items()) {
    ClinicalTest test = testFrom(json, skeleton);
    test.threshold_mass_kg = all.reference_mass_kg;
    test.threshold_band_share = band;
    if (test.form)
      for (const auto& group : test.form->groups) all.group(group);  // must exist
    const auto same = [&](const ClinicalTest& t) {
      return t.id == test.id || std::ranges::count(t.aliases, test.id);
    };
    if (std::ranges::any_of(all.tests, same)) json["id"].fail("an id of its own", "'" + test.id + "' twice");
    all.tests.push_back(std::move(test));
  }
}

ClinicalTests load(const std::filesystem::path& resource_dir, const Skeleton* skeleton) {
  const auto file = resource_dir / "clinical" / "clinical_tests.json";
  const Json document = parseJson(readFile(file), file.filename().string());
  const JsonReader root{document, file.filename().string()};
  root.expectFormat("sinew.clinical_tests", 1);
  root.allowOnly({"format", "version", "note", "reference_mass_kg", "reference_mass_source", "threshold_band",
                  "threshold_band_source", "length_sd_m", "length_sd_source", "thresholds", "groups", "tests",
                  "couplings", "contradictions", "not_asked"});
  ClinicalTests all;
  all.thresholds = root["thresholds"].text();
  all.reference_mass_kg = root["reference_mass_kg"].positive();
  all.length_sd_m = root["length_sd_m"].positive();
  all.length_sd_source = root["length_sd_source"].text();
  for (const auto& json : root["groups"].items()) {
    json.allowOnly({"name", "title", "units"});
    LengthGroup group{json["name"].text(), json["title"].text(), {}};
    for (const auto& unit : json["units"].items()) group.units.push_back(unit.text());
    all.groups.push_back(group);
  }
  addTests(root, skeleton, all);
  for (const auto& json : root["couplings"].items()) all.couplings.push_back(couplingFrom(json, all));
  for (const auto& json : root["contradictions"].items()) all.contradictions.push_back(contradictionFrom(json, all));
  for (const auto& json : root["not_asked"].items()) {
    json.allowOnly({"id", "reason"});
    all.not_asked.push_back({json["id"].text(), json["reason"].text()});
  }
  return all;
}

}  // namespace

ClinicalTests loadClinicalTests(const std::filesystem::path& resource_dir) {
  return load(resource_dir, nullptr);
}
ClinicalTests loadClinicalTests(const std::filesystem::path& resource_dir, const Skeleton& skeleton) {
  return load(resource_dir, &skeleton);
}

}  // namespace sinew
