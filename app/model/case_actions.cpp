#include "app/model/case_actions.h"
#include "core/text.h"

#include <algorithm>
#include <set>

#include "clinical/pipeline/side_check.h"

namespace sinew {
namespace {

auto sightingIn(std::vector<Sighting>& sightings, std::string_view name, int view) {
  return std::ranges::find_if(sightings, [&](const Sighting& s) { return s.name == name && s.view == view; });
}

ExamEntry& entryOf(Case& c, const std::string& test, char side) {
  auto& entries = c.exam.entries;
  const auto found =
      std::ranges::find_if(entries, [&](const ExamEntry& e) { return e.test == test && e.side == side; });
  if (found != entries.end()) return *found;
  ExamEntry entry;
  entry.test = test;
  entry.side = side;
  entries.push_back(entry);
  return entries.back();
}

/// A line that says nothing is no line.
void dropEmptyEntries(Case& c) {
  std::erase_if(c.exam.entries,
                [](const ExamEntry& e) { return !e.measured_deg && e.note.empty() && !e.threshold_Nm; });
}

}  // namespace

const Sighting* findSighting(const Case& c, std::string_view name, int view) {
  const auto found =
      std::ranges::find_if(c.sightings, [&](const Sighting& s) { return s.name == name && s.view == view; });
  return found == c.sightings.end() ? nullptr : &*found;
}

void setSighting(Case& c, const std::string& name, int view, const Eigen::Vector2d& uv_px, double sigma_px) {
  const auto found = sightingIn(c.sightings, name, view);
  if (found != c.sightings.end())
    found->uv_px = uv_px;
  else
    c.sightings.push_back({name, view, uv_px, sigma_px});
}

void removeSighting(Case& c, std::string_view name, int view) {
  if (const auto found = sightingIn(c.sightings, name, view); found != c.sightings.end()) c.sightings.erase(found);
}

void exchangeSides(Case& c) {
  applyExchange(c.sightings, c.exchanged_sides);
  c.exchanged_sides.clear();
}

double typicalSigma_px(const Case& c) {
  if (c.sightings.empty()) return 1.0;
  std::vector<double> sigmas;
  for (const auto& s : c.sightings) sigmas.push_back(s.sigma_px);
  std::ranges::nth_element(sigmas, sigmas.begin() + std::ptrdiff_t(sigmas.size() / 2));
  return sigmas[sigmas.size() / 2];
}

std::vector<std::string> landmarkNames(const Case& c, const std::vector<std::string>& protocol) {
  std::vector<std::string> names = protocol;
  std::set<std::string> known(protocol.begin(), protocol.end());
  for (const auto& s : c.sightings)
    if (known.insert(s.name).second) names.push_back(s.name);
  return names;
}

const ExamEntry* findExamEntry(const Case& c, std::string_view test, char side) {
  const auto& entries = c.exam.entries;
  const auto found =
      std::ranges::find_if(entries, [&](const ExamEntry& e) { return e.test == test && e.side == side; });
  return found == entries.end() ? nullptr : &*found;
}

void setMeasured(Case& c, const ClinicalTests& protocol, const std::string& test, char side,
                 std::optional<double> measured_deg) {
  entryOf(c, test, side).measured_deg = measured_deg;
  dropEmptyEntries(c);
  checkExam(c.exam, protocol);
}

void setExamNote(Case& c, const std::string& test, char side, const std::string& note) {
  entryOf(c, test, side).note = note;
  dropEmptyEntries(c);
}

void setThreshold(Case& c, const std::string& test, char side, std::optional<double> threshold_Nm) {
  if (threshold_Nm && !(*threshold_Nm >= 1 && *threshold_Nm <= 200))
    throw InputError{{"examination", "stop torque", "1 to 200 N m", brief(*threshold_Nm, 3) + " N m"}};
  entryOf(c, test, side).threshold_Nm = threshold_Nm;
  dropEmptyEntries(c);
}

void useImportedRig(Case& c, const BiplanarRig& rig) {
  c.imported_rig = rig;
  c.phantom.reset();
}

void usePhantom(Case& c, const PhantomImages& phantom) {
  c.phantom = phantom;
  c.imported_rig.reset();
}

void useImageTags(Case& c) {
  c.phantom.reset();
  c.imported_rig.reset();
}

RigSource rigSource(const Case& c) {
  if (c.imported_rig) return RigSource::Imported;
  return c.phantom ? RigSource::Phantom : RigSource::ImageTags;
}

}  // namespace sinew
