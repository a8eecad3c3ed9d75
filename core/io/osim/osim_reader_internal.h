#pragma once
#include <map>
#include <string>

#include "core/foreign/foreign_model.h"
#include "core/io/osim/xml_internal.h"

namespace sinew {

/// A frame of the document as a place on a body.
struct OsimFrame {
  int body = -1;
  RigidTransform X_BF = RigidTransform::Identity();
};

/// What the parts of the reader share: the model that grows, and names.
class OsimReader {
 public:
  OsimReader(XmlElement document, std::string fallback_name);
  ForeignModel model() && { return std::move(model_); }

 private:
  // osim_reader.cpp
  void readBodies();
  void readFrames(const XmlElement& owner, int body);
  void readOwnFrames(const XmlElement& frames, const std::string& owner_path);
  OsimFrame frame(const XmlElement& reference, const std::string& owner_path = {}) const;
  OsimFrame bodyNamed(const XmlElement& reference, const std::string& name) const;
  void readCouplings();
  void sortCouplings(std::vector<ForeignCoupling> unsorted);
  void warnAboutTheRest();
  int coordinate(const XmlElement& reference, const std::string& name) const;
  void warn(const std::string& code, const std::string& message) { model_.warnings.push_back({code, message}); }

  // osim_joints.cpp
  void readJoints();
  void readOldJoint(const XmlElement& joint, OsimFrame on_child);
  void readJoint(const XmlElement& joint, const OsimFrame& parent, const OsimFrame& child);
  void readCoordinates(const XmlElement& joint, ForeignJoint& into);
  void fixedMotion(ForeignJoint& joint);
  void customMotion(const XmlElement& joint, ForeignJoint& into);
  void orderJoints();
  void markTranslations();

  // osim_functions.cpp
  /// The function in `holder`, directly or inside <function>; of these coordinates.
  CoordinateFunction function(const XmlElement& holder, const std::vector<int>& coordinates);
  CoordinateFunction functionElement(const XmlElement& element, const std::vector<int>& coordinates, int depth = 0);
  ScalarFunction splineElement(const XmlElement& element);

  // osim_forces.cpp
  bool readCoordinateForce(const XmlElement& force);

  // osim_muscles.cpp
  void readWrapObjects(const XmlElement& owner, int body);
  void readWrapObject(const XmlElement& object, int body);
  void readMuscles();
  void readMuscle(const XmlElement& muscle);
  ForeignPath path(const XmlElement& geometry, const std::string& muscle);
  ForeignPathPoint pathPoint(const XmlElement& point);
  void readPathWraps(const XmlElement& geometry, const std::string& muscle, ForeignPath& into);
  void noteCurves(const XmlElement& muscle);
  void warnAboutCurves();

  XmlElement document_, root_;
  ForeignModel model_;
  std::map<std::string, OsimFrame, std::less<>> frames_;  ///< by path ("/bodyset/femur_r", "/jointset/knee/f")
  std::map<std::string, std::string, std::less<>> unused_wraps_;  ///< not used, and why: their kind
  std::map<std::string, std::vector<std::string>>
      other_curves_;  ///< "KshapeActive" -> muscles whose value is not ours
};

/// Objects of a set: <XSet><objects>..</objects></XSet>; empty if the set is missing.
std::vector<XmlElement> osimObjects(const XmlElement& owner, const char* set);
/// Fixed pose of a translation and an intrinsic x-y-z sequence.
RigidTransform osimPose(const std::optional<XmlElement>& translation, const std::optional<XmlElement>& orientation);
/// "/bodyset/femur_r" -> "femur_r".
std::string lastOfPath(const std::string& path);

}  // namespace sinew
