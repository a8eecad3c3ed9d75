#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Quantities that rows of the audit's tables may name.
const std::vector<std::string>& auditQuantities();

/// "soleus_*" fits "soleus_medial_r"; without a star the whole name must agree, side apart.
bool fits(const std::string& pattern, std::string_view unit);
bool fits(const std::vector<std::string>& patterns, std::string_view unit);

}  // namespace sinew
