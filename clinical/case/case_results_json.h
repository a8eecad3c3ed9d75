#pragma once
#include "clinical/case/case.h"
#include "core/strict_json.h"

namespace sinew {

// What the stages leave in case.json, one pair of functions a result. SI units; NaN is null. Reading is strict:
// @throws InputError with the field path.

Json triangulationToJson(const Triangulation& landmarks);
Triangulation triangulationFromJson(const JsonReader& json);

Json exchangesToJson(const std::vector<SideExchange>& exchanges);
std::vector<SideExchange> exchangesFromJson(const JsonReader& json);

Json skeletonFitToJson(const SkeletonFit& fit);
SkeletonFit skeletonFitFromJson(const JsonReader& json);

Json truthToJson(const Truth& truth);
Truth truthFromJson(const JsonReader& json);

Json stageRecordToJson(const StageRecord& record);
StageRecord stageRecordFromJson(const JsonReader& json);

}  // namespace sinew
