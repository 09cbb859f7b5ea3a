#pragma once
// Sections 'SETT' (what a file was baked for) and 'PLAN' (what is in it and why).
#include "engine/baked/baked_file.h"
#include "engine/baked/bytes.h"

namespace daylit {

Bytes code_settings(const Baked& baked);
void decode_settings(ByteReader bytes, Baked& baked);

Bytes code_plan(const std::vector<PlanItem>& plan);
std::vector<PlanItem> decode_plan(ByteReader bytes);

}  // namespace daylit
