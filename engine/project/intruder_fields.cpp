// SPDX-License-Identifier: MIT
// The fields of an intruder.
#include <fmt/format.h>

#include "project/field_list.h"

namespace sigs {

namespace {

void add_model(FieldList list, ModelSettings& model) {
  list.path("file", model.file, true, "the aircraft: a Wavefront OBJ file");
  list.add("forward", &model.forward, "", "axis of the file that points out of the nose: +x -x +y -y +z -z");
  list.add("up", &model.up, "", "axis of the file that points up");
  list.number("scale", &model.scale, "m", 1e-9, 1e9, "metres a unit of the file");
  list.number("length_m", &model.length_m, "m", 0, 1e6, "wanted length from nose to tail; 0: scale says");
  list.add("anchor", choice_of(model.anchor, {"origin", "bounds"}), "",
           "reference point that flies along the trajectory: the file's origin or the centre of its bounds");
  list.number("gloss", &model.gloss, "", 0, 100, "factor of its highlights; 0: matt");
}

void add_rotor(FieldList list, RotorSettings& rotor) {
  list.add("part", &rotor.part, "", "material, group or object of the model's file that is a rotor").required = true;
  list.number("blades", &rotor.blades, "", 0, 16, "how many it has; 0: the part is left out, as a second propeller");
  list.number("rpm", &rotor.rpm, "rpm", -1e6, 1e6,
              "positive: counter-clockwise seen from where the axis points; null: tips at 200 m/s, a guess");
  list.number("radius_m", &rotor.radius_m, "m", 0, 1000, "0: as far as its faces reach from their middle");
  list.number("hub_m", &rotor.hub_m, "m", -kFarthest_m, kFarthest_m,
              "with radius_m: where it is, in body axes; faces within radius_m of it are the rotor");
  list.number("axis", &rotor.axis, "", -1, 1,
              "in body axes, up is [0, 0, -1]; [0, 0, 0]: where its faces look, which form a disc");
  list.number("chord_m", &rotor.chord_m, "m", 0, 100, "width of a blade; 0: a 15th of the radius, a guess");
  list.number("phase_deg", &rotor.phase_deg, "deg", -360, 360, "of the first blade at time 0, from the nose");
  list.number("coning_deg", &rotor.coning_deg, "deg", -30, 30, "by which blades rise towards the axis");
}

void add_contrail(FieldList list, ContrailSettings& contrail) {
  list.number("strands", &contrail.strands, "", 0, 4, "trails of ice behind a jet, one for each engine; 0: none");
  list.number("length_m", &contrail.length_m, "m", 1, 1e6, "how far behind the aircraft nothing of it is left");
  list.number("width_m", &contrail.width_m, "m", 0.01, 1000, "of a strand where it begins");
  list.number("spread_mps", &contrail.spread_mps, "m/s", 0, 100, "how fast a strand widens: a quarter of its width");
  list.number("opacity", &contrail.opacity, "", 0, 1, "of a strand where it begins, seen from the side");
  list.number("brightness", &contrail.brightness, "", 0, 10, "1: as bright as a white surface squarely in the sun");
}

void add_lights(FieldList list, LampSettings& lights) {
  list.number("position_cd", &lights.position_cd, "cd", 0, 1e9, "position lights, red and green ahead; 0: none");
  list.number("strobe_cd", &lights.strobe_cd, "cd", 0, 1e9, "effective intensity of white strobes; 0: none");
  list.number("beacon_cd", &lights.beacon_cd, "cd", 0, 1e9, "effective intensity of red beacons; 0: none");
  list.number("landing_cd", &lights.landing_cd, "cd", 0, 1e9, "middle of the landing light's beam, ahead; 0: none");
  list.number("landing_beam_deg", &lights.landing_beam_deg, "deg", 0.1, 180, "the beam's full width at half of that");
  list.number("flashes_per_minute", &lights.flashes_per_minute, "/min", 1, 6000, "of strobes and beacons, by turns");
  list.number("flash_s", &lights.flash_s, "s", 1e-6, 10, "how long a flash lasts: xenon 0.001, LED 0.1");
  list.number("phase", &lights.phase, "", -1e6, 1e6, "of the first strobe's flash at frame 0, in flashes");
}

void add_heat(FieldList list, HeatSettings& heat) {
  list.number("skin", &heat.skin, "code", 0, 10'000, "thermal: how much warmer than the sky its skin looks");
  list.number("engine", &heat.engine, "code", 0, 10'000, "the same of engines, nacelles and cowls");
  list.number("exhaust", &heat.exhaust, "code", 0, 10'000, "of exhausts and nozzles");
  list.number("glass", &heat.glass, "code", 0, 10'000, "of glass, which is opaque to heat");
  list.number("rotor", &heat.rotor, "code", 0, 10'000, "of blades");
}

void add_trajectory(FieldList list, TrajectoryPlan& plan) {
  list.add("spline", choice_of(plan.spline, {"interpolating", "approximating"}), "",
           "through the waypoints, or the paper's uniform B-spline that takes them as control points");
  list.add("timing", choice_of(plan.timing, {"frames", "constant_speed"}), "",
           "at each waypoint in its frame, or along the same curve at one speed");
  list.add(
      "attitude", choice_of(plan.attitude, {"path", "helicopter", "multirotor", "balloon"}), "",
      "path: nose along the path, as airplanes fly; the others: heading apart from it, tilted by the thrust; level");
  list.add("bank", choice_of(plan.bank, {"coordinated", "level"}), "", "bank as in a coordinated turn, or wings level");
  list.number("bank_limit_deg", &plan.bank_limit_deg, "deg", 0, 90, "steepest bank");
}

void add_place(FieldList& list, PlaceSettings& place) {
  list.number("latitude_deg", &place.latitude_deg, "deg", -90, 90, "instead of position_m: where on the Earth, WGS-84");
  list.number("longitude_deg", &place.longitude_deg, "deg", -180, 180, "with latitude_deg");
  list.number("height_m", &place.height_m, "m", -1e4, 1e8, "with latitude_deg: above the ellipsoid");
}

}  // namespace

void add_intruder(std::vector<Field>& fields, const std::string& prefix, IntruderSettings& intruder) {
  FieldList(fields, prefix).add("name", &intruder.name, "", "what the annotations call it");
  FieldList(fields, prefix).add("category", &intruder.category, "", "what kind of thing labels call it").required =
      true;
  FieldList(fields, prefix)
      .add("role", choice_of(intruder.role, {"intruder", "distractor"}), "",
           "distractor: what detectors should not report, such as a bird; evaluation counts it as no intruder");
  add_model(FieldList(fields, prefix + "model."), intruder.model);
  for (std::size_t j = 0; j < intruder.model.rotors.size(); ++j)
    add_rotor(FieldList(fields, fmt::format("{}model.rotors[{}].", prefix, j)), intruder.model.rotors[j]);
  add_contrail(FieldList(fields, prefix + "contrail."), intruder.contrail);
  add_lights(FieldList(fields, prefix + "lights."), intruder.lights);
  add_heat(FieldList(fields, prefix + "heat."), intruder.heat);
  add_trajectory(FieldList(fields, prefix + "trajectory."), intruder.trajectory);
  for (std::size_t j = 0; j < intruder.trajectory.waypoints.size(); ++j) {
    WaypointSettings& waypoint = intruder.trajectory.waypoints[j];
    FieldList list(fields, fmt::format("{}trajectory.waypoints[{}].", prefix, j));
    list.number("frame", &waypoint.frame, "frame", -1e9, 1e9, "frame at which it is passed; none: spread evenly");
    list.number("heading_deg", &waypoint.heading_deg, "deg", -360, 360,
                "of the nose, from world X to the right; null: between those of others, else the path's; not of path");
    list.number("position_m", &waypoint.position_m, "m", -kFarthest_m, kFarthest_m, "where, in the world");
    if (waypoint.place) add_place(list, *waypoint.place);
  }
}

}  // namespace sigs
