// A robot with two wheels and a caster in ODE, set up as Gazebo Classic sets ODE up: hinges driven
// by velocity with a greatest torque, QuickStep with 50 iterations, friction the smaller of two.
//
// Usage: physics_ode ball|cylinder < jobs. A job is a line `NAME AHEAD TURN SECONDS BLOCK`:
// commanded speed [m/s] and turn [rad/s], and what stands in the way (none, wall, step). The answer
// is a JSON line. The robot is robots/sam_bot of this repository, whose wheels touch by a ball or by
// a cylinder.
#include <ode/ode.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <string>

namespace {

constexpr double kStep = 0.001;
constexpr int kChunk = 100;  // steps timed together; the fastest count
constexpr double kRadius = 0.10;
constexpr double kSeparation = 0.36;

struct Bench {
  dWorldID world;
  dSpaceID space;
  dJointGroupID contacts;
  std::map<dGeomID, double> friction;
};

void OnNear(void* user, dGeomID one, dGeomID two) {
  auto* bench = static_cast<Bench*>(user);
  dBodyID first = dGeomGetBody(one);
  dBodyID second = dGeomGetBody(two);
  if (first == second || (first && second)) return;  // parts of the robot pass through each other
  dContact contacts[8];
  const int count = dCollide(one, two, 8, &contacts[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    auto& surface = contacts[i].surface;
    surface.mode = dContactSoftERP | dContactSoftCFM | dContactApprox1;
    surface.mu = std::min(bench->friction[one], bench->friction[two]);
    surface.soft_erp = 0.2;
    surface.soft_cfm = 1e-6;
    dJointAttach(dJointCreateContact(bench->world, bench->contacts, &contacts[i]), first, second);
  }
}

struct Robot {
  dBodyID base;
  dJointID hinges[2];
  double ahead, up;  // of the centre of mass, from the middle of the body

  Robot(Bench& bench, bool ball) {
    dMass mass, caster;
    dMassSetBoxTotal(&mass, 15, .42, .31, .18);
    dMassSetSphereTotal(&caster, .5, .06);
    dMassTranslate(&caster, .14, 0, -.09);
    dMassAdd(&mass, &caster);
    ahead = mass.c[0];
    up = mass.c[2];
    dMassTranslate(&mass, -ahead, 0, -up);  // an ODE body is its centre of mass
    base = dBodyCreate(bench.world);
    dBodySetMass(base, &mass);
    dBodySetPosition(base, ahead, 0, .15 + up);
    Add(bench, dCreateBox(bench.space, .42, .31, .18), base, 1.0, -ahead, -up);
    Add(bench, dCreateSphere(bench.space, .06), base, .001, .14 - ahead, -.09 - up);
    for (int side = 0; side < 2; ++side) {
      const double y = side == 0 ? kSeparation / 2 : -kSeparation / 2;
      dBodyID wheel = dBodyCreate(bench.world);
      dMassSetCylinderTotal(&mass, .5, 2, kRadius, .04);
      dBodySetMass(wheel, &mass);
      dBodySetPosition(wheel, -.12, y, kRadius);
      dGeomID tyre = ball ? dCreateSphere(bench.space, kRadius)
                          : dCreateCylinder(bench.space, kRadius, .04);
      Add(bench, tyre, wheel, 1.0, 0, 0);
      if (!ball) {
        dQuaternion across;
        dQFromAxisAndAngle(across, 1, 0, 0, M_PI / 2);
        dGeomSetOffsetQuaternion(tyre, across);
      }
      hinges[side] = dJointCreateHinge(bench.world, nullptr);
      dJointAttach(hinges[side], wheel, base);
      dJointSetHingeAnchor(hinges[side], -.12, y, kRadius);
      dJointSetHingeAxis(hinges[side], 0, 1, 0);
      dJointSetHingeParam(hinges[side], dParamFMax, 20);
      dJointSetHingeParam(hinges[side], dParamVel, 0);
    }
  }

  static void Add(Bench& bench, dGeomID shape, dBodyID body, double friction, double x, double z) {
    dGeomSetBody(shape, body);
    dGeomSetOffsetPosition(shape, x, 0, z);
    bench.friction[shape] = friction;
  }

  double Yaw() const {
    const dReal* r = dBodyGetRotation(base);
    return std::atan2(r[4], r[0]);
  }

  // The frame in the middle of the body, which is not the centre of mass.
  void Middle(double out[3]) const {
    dVector3 point;
    dBodyGetRelPointPos(base, -ahead, 0, -up, point);
    std::copy(point, point + 3, out);
  }
};

void Drive(bool ball, const std::string& name, double ahead, double turn, double seconds,
           const std::string& block) {
  Bench bench{dWorldCreate(), dHashSpaceCreate(nullptr), dJointGroupCreate(0), {}};
  dRandSetSeed(0);
  dWorldSetGravity(bench.world, 0, 0, -9.81);
  dWorldSetQuickStepNumIterations(bench.world, 50);
  dWorldSetERP(bench.world, 0.2);
  dWorldSetCFM(bench.world, 1e-9);
  dWorldSetContactSurfaceLayer(bench.world, 0.001);
  dWorldSetContactMaxCorrectingVel(bench.world, 100);
  bench.friction[dCreatePlane(bench.space, 0, 0, 1, 0)] = 1;
  if (block == "wall") {
    dGeomID wall = dCreateBox(bench.space, .2, 6, 1);
    dGeomSetPosition(wall, 2.1, 0, .5);
    bench.friction[wall] = 1;
  } else if (block == "step") {
    dGeomID step = dCreateBox(bench.space, 2, 6, .01);
    dGeomSetPosition(step, 2, 0, .005);
    bench.friction[step] = 1;
  }
  Robot robot(bench, ball);
  auto step = [&] {
    dSpaceCollide(bench.space, &bench, OnNear);
    dWorldQuickStep(bench.world, kStep);
    dJointGroupEmpty(bench.contacts);
  };
  for (int i = 0; i < std::lround(1 / kStep); ++i) step();
  double start[3], end[3];
  robot.Middle(start);
  const double heading = robot.Yaw();
  double last = heading, turned = 0, wheels[2] = {0, 0};
  for (int side = 0; side < 2; ++side) {
    const double sign = side == 0 ? -1 : 1;
    // The base is the hinge's second body: its angle counts the other way round.
    dJointSetHingeParam(robot.hinges[side], dParamVel,
                        (ahead + sign * turn * kSeparation / 2) / kRadius);
  }
  const long steps = std::lround(seconds / kStep);
  auto began = std::chrono::steady_clock::now();
  double best = 1e9;
  for (long i = 0; i < steps; ++i) {
    step();
    const double now = robot.Yaw();
    turned += std::remainder(now - last, 2 * M_PI);
    last = now;
    for (int side = 0; side < 2; ++side)
      wheels[side] += kStep * dJointGetHingeAngleRate(robot.hinges[side]);
    if ((i + 1) % kChunk == 0) {
      const auto now = std::chrono::steady_clock::now();
      best = std::min(best, std::chrono::duration<double>(now - began).count());
      began = now;
    }
  }
  robot.Middle(end);
  const double dx = end[0] - start[0], dy = end[1] - start[1];
  const double c = std::cos(heading), s = std::sin(heading);
  std::printf("{\"test\":\"%s\",\"along_m\":%.9g,\"aside_m\":%.9g,\"turned_rad\":%.9g,"
              "\"left_rad\":%.9g,\"right_rad\":%.9g,\"height_m\":%.9g,\"us_per_step\":%.6g}\n",
              name.c_str(), c * dx + s * dy, c * dy - s * dx, turned, wheels[0], wheels[1], end[2],
              best / kChunk * 1e6);
  std::fflush(stdout);
  dJointGroupDestroy(bench.contacts);
  dSpaceDestroy(bench.space);
  dWorldDestroy(bench.world);
}

}  // namespace

int main(int count, char** words) {
  const bool ball = count > 1 && std::string(words[1]) == "ball";
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  std::printf("{\"engine\":\"ODE QuickStep 50\"}\n");
  std::string name, block;
  double ahead, turn, seconds;
  while (std::cin >> name >> ahead >> turn >> seconds >> block)
    Drive(ball, name, ahead, turn, seconds, block);
  dCloseODE();
}
