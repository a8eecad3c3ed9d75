#pragma once
#include <vector>

#include "core/rom/tests/clinical_tests.h"

namespace sinew {

/// Passive moment at which the examiner of a body of this mass stops [N m]: in proportion to mass, the share of its
/// weight that an examiner lifts on the same lever. The one place where thresholds are scaled. Where nobody
/// has weighed the patient, bodyMass_kg() of the model's skeleton is the mass (core/passive/structures.h).
inline double scaledThreshold_Nm(const ClinicalTest& test, double mass_kg) {
  return test.threshold_Nm * mass_kg / test.threshold_mass_kg;
}

/// The same by coordinate, of the first test that moves it alone; infinite where there is none: nobody examines it.
std::vector<double> examinerMoments_Nm(const ClinicalTests& tests, const Skeleton& skeleton, double mass_kg);

}  // namespace sinew
