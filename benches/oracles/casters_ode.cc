// A cart between two casters in ODE, set up as Gazebo Classic sets ODE up: hinges driven by velocity
// with a greatest torque, QuickStep with 50 iterations, a surface layer of 1 mm, contacts as springs
// (`soft_erp` = h kp / (h kp + kd), `soft_cfm` = 1 / (h kp + kd), after ODEPhysics.cc of Gazebo).
//
// Usage: casters_ode KP KD < jobs. A job is a line `DROP FRICTION`: how much too low the casters are
// [m], and their friction. The answer is the way [m] in 5 s at 0.3 m/s, after a second of standing.
// The cart is that of crates/simulation/physics/tests/casters/cart.rs.
#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>

namespace {

constexpr double kStep = 0.001;
constexpr double kRadius = 0.035;
constexpr double kCaster = 0.0175;
constexpr double kSpeed = 0.3;

struct Bench {
  dWorldID world;
  dSpaceID space;
  dJointGroupID contacts;
  double erp, cfm;
  std::map<dGeomID, double> friction;
};

void OnNear(void* user, dGeomID one, dGeomID two) {
  auto* bench = static_cast<Bench*>(user);
  dBodyID first = dGeomGetBody(one);
  dBodyID second = dGeomGetBody(two);
  if (first == second || (first && second)) return;  // parts of the cart pass through each other
  dContact contacts[8];
  const int count = dCollide(one, two, 8, &contacts[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    auto& surface = contacts[i].surface;
    surface.mode = dContactSoftERP | dContactSoftCFM | dContactApprox1;
    surface.mu = std::min(bench->friction[one], bench->friction[two]);
    surface.soft_erp = bench->erp;
    surface.soft_cfm = bench->cfm;
    dJointAttach(dJointCreateContact(bench->world, bench->contacts, &contacts[i]), first, second);
  }
}

double Drive(double kp, double kd, double drop, double friction) {
  // Two equal springs in series, two dampers side by side.
  const double stiff = kStep * kp / 2, soft = 2 * kd;
  Bench bench{dWorldCreate(), dHashSpaceCreate(nullptr), dJointGroupCreate(0),
              stiff / (stiff + soft), 1 / (stiff + soft), {}};
  dRandSetSeed(0);
  dWorldSetGravity(bench.world, 0, 0, -9.81);
  dWorldSetQuickStepNumIterations(bench.world, 50);
  dWorldSetERP(bench.world, 0.2);
  dWorldSetCFM(bench.world, 0);
  dWorldSetContactSurfaceLayer(bench.world, 0.001);
  dWorldSetContactMaxCorrectingVel(bench.world, 100);
  bench.friction[dCreatePlane(bench.space, 0, 0, 1, 0)] = 1;
  dMass mass, part;
  dMassSetBoxTotal(&mass, 2.5, .16, .16, .01);
  for (double x : {.052, -.052}) {
    dMassSetSphereTotal(&part, .03, kCaster);
    dMassTranslate(&part, x, 0, -.0225 - drop);
    dMassAdd(&mass, &part);
  }
  const double up = mass.c[2];
  dMassTranslate(&mass, 0, 0, -up);  // an ODE body is its centre of mass
  dBodyID deck = dBodyCreate(bench.world);
  dBodySetMass(deck, &mass);
  dBodySetPosition(deck, 0, 0, .04 + up);
  for (double x : {.052, -.052}) {
    dGeomID caster = dCreateSphere(bench.space, kCaster);
    dGeomSetBody(caster, deck);
    dGeomSetOffsetPosition(caster, x, 0, -.0225 - drop - up);
    bench.friction[caster] = friction;
  }
  dJointID hinges[2];
  for (int side = 0; side < 2; ++side) {
    const double y = side == 0 ? .087 : -.087;
    dBodyID wheel = dBodyCreate(bench.world);
    dMassSetCylinderTotal(&mass, .06, 2, kRadius, .005);
    dBodySetMass(wheel, &mass);
    dBodySetPosition(wheel, 0, y, kRadius);
    dGeomID tyre = dCreateCylinder(bench.space, kRadius, .005);
    dGeomSetBody(tyre, wheel);
    dQuaternion across;
    dQFromAxisAndAngle(across, 1, 0, 0, M_PI / 2);
    dGeomSetOffsetQuaternion(tyre, across);
    bench.friction[tyre] = 1;
    hinges[side] = dJointCreateHinge(bench.world, nullptr);
    dJointAttach(hinges[side], wheel, deck);
    dJointSetHingeAnchor(hinges[side], 0, y, kRadius);
    dJointSetHingeAxis(hinges[side], 0, 1, 0);
    dJointSetHingeParam(hinges[side], dParamFMax, 20);
  }
  auto step = [&](double speed) {
    for (dJointID hinge : hinges) dJointSetHingeParam(hinge, dParamVel, speed / kRadius);
    dSpaceCollide(bench.space, &bench, OnNear);
    dWorldQuickStep(bench.world, kStep);
    dJointGroupEmpty(bench.contacts);
  };
  for (int i = 0; i < 1000; ++i) step(0);
  const double start = dBodyGetPosition(deck)[0];
  for (int i = 0; i < 5000; ++i) step(std::min(kSpeed, i * kStep));
  const double way = dBodyGetPosition(deck)[0] - start;
  dJointGroupDestroy(bench.contacts);
  dSpaceDestroy(bench.space);
  dWorldDestroy(bench.world);
  return way;
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return 2;
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  double drop, friction;
  while (std::cin >> drop >> friction)
    std::printf("%.6f\n", Drive(std::atof(words[1]), std::atof(words[2]), drop, friction));
  dCloseODE();
}
