#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/model/model.h"

namespace sinew {

// Plausibility audit: the physiological figures of every unit against ranges from the literature. Lengths are judged
// at the reference's size: divided by the size of the segments that the unit hangs on. See docs/methods/audit.md.

/// Range of one quantity for the units that `units` names (muscles/literature_ranges.csv).
struct LiteratureRange {
  std::vector<std::string> units;  ///< names without side; "soleus_*" = any ending; "*" = all
  std::string quantity;            ///< "pcsa_cm2"
  double low = 0, high = 0;
  bool verified = false;  ///< compared with the source itself
  std::string source;
};

/// Why values beyond the range, but within this wider one, are right (muscles/audit_explanations.csv).
struct AuditExplanation {
  std::vector<std::string> units;
  std::string quantity;
  double low = 0, high = 0;
  std::string reason;
};

struct AuditRanges {
  std::vector<LiteratureRange> ranges;  ///< rows for all units first; of several that fit, the last holds
  std::vector<AuditExplanation> explanations;
  Musculature published;  ///< as in muscles.csv, before fibre and tendon were fitted to the skeleton
};

/// @throws InputError naming file, line, field; also for a row that names none of the published units.
AuditRanges loadAuditRanges(const std::filesystem::path& resource_dir, const Skeleton& reference);

enum class AuditVerdict { Inside, Explained, Outlier };

struct AuditFinding {
  std::string unit;      ///< or the units of a whole muscle: "soleus_*_r"
  std::string quantity;  ///< of LiteratureRange; or "parameters": a figure that is no figure at all
  double value = 0, low = 0, high = 0;
  AuditVerdict verdict = AuditVerdict::Outlier;
  bool verified = false;  ///< the range
  std::string source;     ///< of the range
  std::string reason;     ///< of an explained value, or what is wrong with a parameter
};

/// The figures of one unit. NaN: cannot be said (not in the published table, or broken parameters).
struct AuditedUnit {
  std::string name;
  double max_isometric_force_N = 0, published_force_N = 0;
  double source_tension_N_cm2 = 0, pcsa_cm2 = 0;
  double body_scale = 1;  ///< size of its segments over the reference's
  double optimal_fiber_length_m = 0, published_fiber_length_m = 0;
  double tendon_slack_length_m = 0, published_tendon_length_m = 0;
  double pennation_rad = 0;
  double path_length_m = 0;  ///< at the zero posture
  double standing_fiber = 0;
  double tendon_to_fiber = 0;
};

struct ModelAudit {
  std::vector<AuditedUnit> units;
  std::vector<AuditFinding> findings;  ///< every judged quantity, in the order of the units
  std::vector<std::string> unjudged;   ///< units that no row for their muscle covers, with the quantity
  long count(AuditVerdict verdict) const;
};

/// Takes any model, a broken one too: what cannot be computed is a finding.
/// @param reference gives the size that lengths are brought to, and path lengths to compare with.
ModelAudit auditModel(const Model& model, const Model& reference, const AuditRanges& ranges);

}  // namespace sinew
