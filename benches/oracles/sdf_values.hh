// Poses and vectors of libsdformat as JSON.

#pragma once

#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector3.hh>

#include "json_writer.hh"

using ignition::math::Pose3d;
using ignition::math::Vector3d;

inline void writePose(Json &_out, const Pose3d &_pose)
{
  const auto &p = _pose.Pos();
  auto q = _pose.Rot();
  q.Normalize();
  // q and -q are one rotation; keep the one whose first nonzero component is positive.
  const double lead = q.W() != 0 ? q.W() : q.X() != 0 ? q.X() : q.Y() != 0 ? q.Y() : q.Z();
  const double sign = lead < 0 ? -1 : 1;
  _out.numbers({p.X(), p.Y(), p.Z(), sign * q.W(), sign * q.X(), sign * q.Y(), sign * q.Z()});
}

inline void writeVector(Json &_out, const Vector3d &_v) { _out.numbers({_v.X(), _v.Y(), _v.Z()}); }
