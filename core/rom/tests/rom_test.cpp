#include "core/rom/tests/rom_test.h"

#include <algorithm>
#include <cmath>

#include "core/file.h"
#include "core/model/rom_preset.h"
#include "core/skeleton/clinical_angles.h"
#include "core/strict_json.h"
#include "core/text.h"

namespace sinew {
namespace {

std::map<std::string, double> coordinatesFrom(const JsonReader& json, std::string_view member,
                                              const Skeleton& skeleton, double limit) {
  std::map<std::string, double> values;
  if (const auto object = json.find(member))
    for (const auto& [name, value] : object->members()) {
      try {
        sidedCoordinate(skeleton, name, 'r');
      } catch (const InputError& error) {
        throw InputError{value.where() + ": " + value.path() + ": " + error.what()};
      }
      values[name] = value.numberIn(-limit, limit);
    }
  return values;
}

/// {"average-adult": {"mean": 74, "sd": 9, "accept": [60, 95]}, "athlete": {"accept": [130, 160]}}.
std::map<std::string, RomNorm, std::less<>> normsFrom(const JsonReader& json) {
  std::map<std::string, RomNorm, std::less<>> norms;
  for (const auto& [preset, entry] : json.members()) {
    entry.allowOnly({"mean", "sd", "accept"});
    RomNorm norm;
    if (const auto mean = entry.find("mean")) norm.mean_deg = mean->number();
    if (const auto sd = entry.find("sd")) norm.sd_deg = sd->positive();
    const auto range = entry["accept"].numbers(2);
    if (range[0] > range[1]) entry["accept"].fail("lower, upper");
    norm.accept_min_deg = range[0], norm.accept_max_deg = range[1];
    norms[preset] = norm;
  }
  return norms;
}

RomTest testFrom(const JsonReader& json, const Skeleton& skeleton) {
  json.allowOnly({"id", "title", "posture_deg", "contralateral_deg", "moves", "reads", "read_offset_deg", "from_deg",
                  "to_deg", "threshold_Nm", "norms", "limited_by", "source", "confidence"});
  RomTest test;
  test.id = json["id"].text();
  test.title = json["title"].text();
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
  test.norms = normsFrom(json["norms"]);
  test.limited_by = json["limited_by"].text();
  test.source = json["source"].text();
  test.confidence = json["confidence"].oneOf({"A", "B", "C"});
  return test;
}

RomCoupling couplingFrom(const JsonReader& json, const RomNorms& norms) {
  json.allowOnly({"id", "title", "first", "second", "sign", "must_be_positive", "norms", "source"});
  RomCoupling c{json["id"].text(), json["title"].text(), json["first"].text(), json["second"].text()};
  norms.test(c.first);
  norms.test(c.second);
  if (const auto sign = json.find("sign")) c.sign = sign->integer(-1, 1);
  c.must_be_positive = json["must_be_positive"].boolean();
  c.norms = normsFrom(json["norms"]);
  c.source = json["source"].text();
  return c;
}

}  // namespace

double RomNorm::outside_deg(double angle_deg) const {
  return std::max({0.0, accept_min_deg - angle_deg, angle_deg - accept_max_deg});
}

std::map<std::string, double> RomTest::sidedPosture(const Skeleton& skeleton, char side) const {
  std::map<std::string, double> sided;
  const auto put = [&](const std::string& name, char s, double value) {
    sided[skeleton.coordinates[sidedCoordinate(skeleton, name, s)].name] = value;
  };
  for (const auto& [name, value] : contralateral_deg) put(name, side == 'r' ? 'l' : 'r', value);
  for (const auto& [name, value] : posture_deg) put(name, side, value);
  for (const auto& [name, share] : moves) put(name, side, share * from_deg);
  return sided;
}

Posture RomTest::posture(const Skeleton& skeleton, char side) const {
  return postureFromDegrees(skeleton, sidedPosture(skeleton, side));
}

const RomTest& RomNorms::test(std::string_view id) const {
  std::vector<std::string> known;
  for (const auto& t : tests) {
    if (t.id == id) return t;
    known.push_back(t.id);
  }
  throw InputError{{"rom_norms.json", "test", "a known test", "'" + std::string{id} + "'" + didYouMean(id, known)}};
}

RomNorms loadRomNorms(const std::filesystem::path& resource_dir, const Skeleton& skeleton) {
  const auto file = resource_dir / "rom" / "rom_norms.json";
  const Json document = parseJson(readFile(file), file.filename().string());
  const JsonReader root{document, file.filename().string()};
  root.expectFormat("sinew.rom_norms", 1);
  root.allowOnly({"format", "version", "note", "thresholds", "tests", "couplings", "not_asked"});
  RomNorms norms;
  norms.thresholds = root["thresholds"].text();
  for (const auto& json : root["tests"].items()) {
    norms.tests.push_back(testFrom(json, skeleton));
    const auto same = [&](const RomTest& t) { return t.id == norms.tests.back().id; };
    if (std::ranges::count_if(norms.tests, same) > 1)
      json["id"].fail("an id of its own", "'" + norms.tests.back().id + "' twice");
  }
  for (const auto& json : root["couplings"].items()) norms.couplings.push_back(couplingFrom(json, norms));
  for (const auto& json : root["not_asked"].items())
    norms.not_asked.push_back({json["id"].text(), json["reason"].text()});
  return norms;
}

}  // namespace sinew
