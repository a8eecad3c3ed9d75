#pragma once
#include <functional>
#include <string>

#include "core/foreign/foreign_model.h"
#include "core/model/model.h"

namespace sinew {

/// How far the moments of capsules and ligaments are from ours in an exported model, over postures inside the body's
/// stops: every coordinate alone from stop to stop, and 100 random ones.
struct StructureDeviation {
  double alone_Nm = 0, random_Nm = 0;  ///< largest difference about a clinical coordinate
  double alone_share = 0;              ///< the first as a share of the moment at the coordinate's stop
  std::string alone_coordinate, random_coordinate;
  bool isExact() const;  ///< within 1e-6 N m
};

/// `theirs`: generalised forces at clinical coordinates [N m; rad], conjugate to their rates. The arm goes beyond 90
/// deg of abduction there: these are the coordinates that another program runs through, not clinicalFromPosture().
StructureDeviation structureDeviation(const Model& model,
                                      const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& theirs);
/// Of a model that foreignFromModel() made, or one read back from its file: coordinates by name.
StructureDeviation structureDeviation(const Model& model, const ForeignModel& foreign);

/// "capsules and ligaments exactly", or by how much they are off.
std::string summaryText(const StructureDeviation& deviation);

}  // namespace sinew
