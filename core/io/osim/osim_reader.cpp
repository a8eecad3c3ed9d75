#include "core/io/osim/osim_reader.h"

#include <algorithm>
#include <set>

#include "core/file.h"
#include "core/io/osim/osim_reader_internal.h"
#include "core/text.h"

namespace sinew {

std::vector<XmlElement> osimObjects(const XmlElement& owner, const char* set) {
  const auto found = owner.find(set);
  if (!found) return {};
  const auto objects = found->find("objects");
  return objects ? objects->children() : std::vector<XmlElement>{};
}

RigidTransform osimPose(const std::optional<XmlElement>& translation, const std::optional<XmlElement>& orientation) {
  RigidTransform X = RigidTransform::Identity();
  if (translation) X.translation() = Eigen::Vector3d{translation->numbers(3).data()};
  if (orientation) {
    const auto angles = orientation->numbers(3);
    X.linear() = rotationAbout<double>(Eigen::Vector3d::UnitX(), angles[0]) *
                 rotationAbout<double>(Eigen::Vector3d::UnitY(), angles[1]) *
                 rotationAbout<double>(Eigen::Vector3d::UnitZ(), angles[2]);
  }
  return X;
}

std::string lastOfPath(const std::string& path) {
  return path.substr(path.find_last_of('/') + 1);
}

OsimReader::OsimReader(XmlElement document, std::string fallback_name) : document_{document}, root_{document} {
  if (document.tag() != "OpenSimDocument") document.fail("<OpenSimDocument>", "<" + document.tag() + ">");
  const std::string version = document.attribute("Version");
  constexpr int kOldest = 20000;
  if (version.empty() || version.find_first_not_of("0123456789") != std::string::npos || version.size() > 6 ||
      std::stoi(version) < kOldest)
    document.fail("Version of " + std::to_string(kOldest) + " or later", "'" + version + "'");
  root_ = document["Model"];
  model_.name = root_.name().empty() ? std::move(fallback_name) : root_.name();
  model_.source = "OpenSim " + version;
  if (const auto credits = root_.find("credits")) model_.credits = credits->text();
  if (const auto gravity = root_.find("gravity")) model_.gravity_W_m_s2 = Eigen::Vector3d{gravity->numbers(3).data()};
  if (const auto units = root_.find("length_units"); units && units->text() != "meters")
    units->fail("meters", "'" + units->text() + "'");
  readBodies();
  readJoints();
  readCouplings();
  readMuscles();
  warnAboutTheRest();
}

void OsimReader::readBodies() {
  frames_["/ground"] = {};
  std::vector<std::pair<XmlElement, int>> owners;
  if (const auto ground = root_.findAny({"Ground", "ground"})) owners.emplace_back(*ground, -1);
  for (const auto& body : osimObjects(root_, "BodySet")) {
    if (body.tag() != "Body") body.fail("<Body>", "<" + body.tag() + ">");
    int index = -1;
    if (body.name().empty()) body.fail("a name", "none");
    if (body.name() != "ground") {
      Segment segment;
      segment.name = body.name();
      if (frames_.contains("/bodyset/" + segment.name)) body.fail("a name of its own", "the name of another body");
      if (const auto mass = body.find("mass")) segment.mass_kg = mass->number();
      if (const auto centre = body.find("mass_center")) segment.p_BCom = Eigen::Vector3d{centre->numbers(3).data()};
      Eigen::Matrix3d& I = segment.inertia_B_kgm2;
      if (const auto inertia = body.find("inertia")) {
        const auto v = inertia->numbers(6);
        I << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
      } else if (body.has("inertia_xx")) {
        I << body["inertia_xx"].number(), body["inertia_xy"].number(), body["inertia_xz"].number(),
            body["inertia_xy"].number(), body["inertia_yy"].number(), body["inertia_yz"].number(),
            body["inertia_xz"].number(), body["inertia_yz"].number(), body["inertia_zz"].number();
      }
      index = static_cast<int>(model_.bodies.size());
      frames_["/bodyset/" + segment.name] = {index, RigidTransform::Identity()};
      model_.bodies.push_back(segment);
    }
    owners.emplace_back(body, index);
  }
  if (model_.bodies.empty()) root_.fail("a <BodySet> with bodies", "none");
  for (const auto& [owner, body] : owners) {
    if (const auto components = owner.find("components")) {
      readOwnFrames(*components, body < 0 ? "/ground" : "/bodyset/" + owner.name());
    }
    readWrapObjects(owner, body);
  }
}

/// Offset frames that a joint or body owns.
void OsimReader::readOwnFrames(const XmlElement& frames, const std::string& owner_path) {
  for (const auto& f : frames.children()) {
    if (f.tag() != "PhysicalOffsetFrame") continue;
    const auto parent = f.findAny({"socket_parent", "socket_parent_connectee_name"});
    if (!parent) f.fail("an element <socket_parent>", "none");
    const OsimFrame base = frame(*parent, owner_path);
    frames_[owner_path + "/" + f.name()] = {base.body,
                                            base.X_BF * osimPose(f.find("translation"), f.find("orientation"))};
  }
}

/// A reference is a path from the model, a path relative to the owner, or a name.
OsimFrame OsimReader::frame(const XmlElement& reference, const std::string& owner_path) const {
  std::string name = reference.text();
  if (name == "..") name = owner_path;
  while (name.starts_with("../")) name = name.substr(3);
  for (const std::string& full : {name, owner_path + "/" + name, "/bodyset/" + name, "/jointset/" + name, "/" + name})
    if (const auto found = frames_.find(full); found != frames_.end()) return found->second;
  return bodyNamed(reference, lastOfPath(name));
}

OsimFrame OsimReader::bodyNamed(const XmlElement& reference, const std::string& name) const {
  if (const auto found = frames_.find("/bodyset/" + name); found != frames_.end()) return found->second;
  if (name == "ground") return {};
  for (const auto& [path, frame] : frames_)
    if (lastOfPath(path) == name) return frame;
  std::vector<std::string> known;
  for (const auto& [path, frame] : frames_) known.push_back(lastOfPath(path));
  reference.fail("a body or frame of the model", "'" + reference.text() + "'" + didYouMean(name, known));
}

int OsimReader::coordinate(const XmlElement& reference, const std::string& path) const {
  const std::string name = lastOfPath(path);
  for (std::size_t i = 0; i < model_.coordinates.size(); ++i)
    if (model_.coordinates[i].name == name) return static_cast<int>(i);
  std::vector<std::string> known;
  for (const auto& c : model_.coordinates) known.push_back(c.name);
  reference.fail("a coordinate of the model", "'" + path + "'" + didYouMean(name, known));
}

void OsimReader::readCouplings() {
  std::vector<ForeignCoupling> couplings;
  for (const auto& constraint : osimObjects(root_, "ConstraintSet")) {
    const auto off = constraint.find("isDisabled"), on = constraint.find("isEnforced");
    if ((off && off->boolean()) || (on && !on->boolean())) continue;
    if (constraint.tag() != "CoordinateCouplerConstraint") {
      warn("osim_constraint", constraint.tag() + " '" + constraint.name() + "' is not held");
      continue;
    }
    ForeignCoupling coupling;
    coupling.name = constraint.name();
    const XmlElement dependent = constraint["dependent_coordinate_name"];
    coupling.dependent = coordinate(dependent, dependent.text());
    if (std::ranges::find(couplings, coupling.dependent, &ForeignCoupling::dependent) != couplings.end())
      dependent.fail("a coordinate that follows one coupling",
                     "'" + dependent.text() + "', which follows another too");
    std::vector<int> independent;
    const XmlElement names = constraint["independent_coordinate_names"];
    for (const auto& name : names.words()) independent.push_back(coordinate(names, name));
    coupling.value = function(constraint["coupled_coordinates_function"], independent);
    if (const auto scale = constraint.find("scale_factor")) {
      coupling.value.constant *= scale->number();
      for (auto& term : coupling.value.terms) term.function = term.function.times(scale->number());
    }
    couplings.push_back(std::move(coupling));
  }
  sortCouplings(std::move(couplings));
}

/// What a coupling depends on comes before it; those that go round in a circle are left out.
void OsimReader::sortCouplings(std::vector<ForeignCoupling> unsorted) {
  while (!unsorted.empty()) {
    const auto ready = std::ranges::find_if(unsorted, [&](const ForeignCoupling& c) {
      return std::ranges::none_of(c.value.terms, [&](const CoordinateFunction::Term& t) {
        return std::ranges::find(unsorted, t.coordinate, &ForeignCoupling::dependent) != unsorted.end();
      });
    });
    if (ready == unsorted.end()) break;
    model_.couplings.push_back(*ready);
    unsorted.erase(ready);
  }
  for (const auto& c : unsorted)
    warn("osim_constraint", "CoordinateCouplerConstraint '" + c.name + "' depends on itself and is not held");
}

/// Parts of the document that lengths and moment arms do not need, or that are not known here.
void OsimReader::warnAboutTheRest() {
  const auto warnSet = [&](const char* set, const char* what) {
    if (const auto objects = osimObjects(root_, set); !objects.empty())
      warn("osim_not_used",
           std::to_string(objects.size()) + " " + what + " are not used, the first '" + objects.front().name() + "'");
  };
  warnSet("ControllerSet", "controllers");
  warnSet("ContactGeometrySet", "contact geometries");
  warnSet("ProbeSet", "probes");
  warnSet("ComponentSet", "other components");
  warnAboutCurves();
}

ForeignModel osimFromText(const std::string& text, const std::string& where) {
  return OsimReader{XmlElement::root(text, where), std::filesystem::path{where}.stem().string()}.model();
}

ForeignModel readOsim(const std::filesystem::path& file) {
  constexpr std::uintmax_t kLargest_bytes = std::uintmax_t{256} << 20;
  return osimFromText(readFile(file, kLargest_bytes), file.string());
}

}  // namespace sinew
