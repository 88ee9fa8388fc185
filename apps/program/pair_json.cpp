// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pair_json.h"

namespace pcl_flashreg::program {

const char*
nameOf(Status status)
{
  switch (status) {
  case Status::Ok:
    return "ok";
  case Status::TooFewCorrespondences:
    return "too_few_correspondences";
  case Status::NoClique:
    return "no_clique";
  default:
    return "degenerate";
  }
}

Json
evidenceOf(const Evidence& evidence)
{
  Json json = {{"inliers", evidence.inliers},
               {"inlier_ratio", evidence.inlier_ratio},
               {"rival_inliers", evidence.rival_inliers},
               {"thickness", evidence.thickness},
               {"breadth", evidence.breadth},
               {"log_chance", evidence.log_chance},
               {"mirrored", evidence.mirrored},
               {"tilted", evidence.tilted}};
  if (evidence.has_clouds) {
    json["viewpoints"] = evidence.has_viewpoints;
    json["one_viewpoint"] = evidence.one_viewpoint;
    json["overruled_viewpoints"] = evidence.overruled_viewpoints;
    json["sides"] = evidence.has_sides;
    json["overruled_sides"] = evidence.overruled_sides;
    json["in_map"] = evidence.in_map;
    json["second_look"] = evidence.second_look;
    json["matched"] = evidence.agreement.matched;
    json["contradicted"] = evidence.agreement.contradicted;
    json["residual"] = evidence.agreement.residual;
    json["lead"] = evidence.lead;
    json["rivals"] = evidence.rivals;
    json["hold"] = evidence.hold;
    json["stiffness"] = evidence.stiffness;
  }
  return json;
}

Json
hypothesisOf(const Hypothesis& hypothesis)
{
  return {{"transformation", rowsOf(hypothesis.T_target_source.toMatrix<double>())},
          {"inliers", hypothesis.inlier_count},
          {"score", hypothesis.score}};
}

Json
freeMotionsOf(const std::vector<FreeMotion>& motions)
{
  Json list = Json::array();
  for (const FreeMotion& motion : motions)
    list.push_back({{"kind", motion.kind == FreeMotion::Kind::Turn ? "turn" : "slide"},
                    {"direction", rowsOf(motion.direction.transpose())[0]},
                    {"point", rowsOf(motion.point.transpose())[0]},
                    {"backward", motion.backward},
                    {"forward", motion.forward}});
  return list;
}

} // namespace pcl_flashreg::program
