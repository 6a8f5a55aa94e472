// The classes of libsdformat (its DOM) as JSON, every pose resolved through the frame graphs.

#pragma once

#include <string>

#include <sdf/sdf.hh>

#include "sdf_values.hh"

/// Poses that no frame graph could resolve, over the file at hand.
inline int g_unresolved = 0;

inline void writeResolved(Json &_out, const sdf::SemanticPose &_semantic, const std::string &_to)
{
  Pose3d pose;
  if (_semantic.Resolve(pose, _to).empty())
    writePose(_out, pose);
  else
  {
    ++g_unresolved;
    _out.null();
  }
}

inline void writeGeometry(Json &_out, const sdf::Geometry *_geometry)
{
  _out.beginObject();
  if (!_geometry)
  {
    _out.key("type").string("none").endObject();
    return;
  }
  switch (_geometry->Type())
  {
    case sdf::GeometryType::BOX:
      _out.key("type").string("box").key("size");
      writeVector(_out, _geometry->BoxShape()->Size());
      break;
    case sdf::GeometryType::CYLINDER:
      _out.key("type").string("cylinder");
      _out.key("radius").number(_geometry->CylinderShape()->Radius());
      _out.key("length").number(_geometry->CylinderShape()->Length());
      break;
    case sdf::GeometryType::CAPSULE:
      _out.key("type").string("capsule");
      _out.key("radius").number(_geometry->CapsuleShape()->Radius());
      _out.key("length").number(_geometry->CapsuleShape()->Length());
      break;
    case sdf::GeometryType::SPHERE:
      _out.key("type").string("sphere");
      _out.key("radius").number(_geometry->SphereShape()->Radius());
      break;
    case sdf::GeometryType::ELLIPSOID:
      _out.key("type").string("ellipsoid").key("radii");
      writeVector(_out, _geometry->EllipsoidShape()->Radii());
      break;
    case sdf::GeometryType::PLANE:
      _out.key("type").string("plane").key("normal");
      writeVector(_out, _geometry->PlaneShape()->Normal());
      _out.key("size").numbers(
          {_geometry->PlaneShape()->Size().X(), _geometry->PlaneShape()->Size().Y()});
      break;
    case sdf::GeometryType::MESH:
    {
      const auto *mesh = _geometry->MeshShape();
      _out.key("type").string("mesh").key("uri").string(mesh->Uri()).key("scale");
      writeVector(_out, mesh->Scale());
      _out.key("submesh").string(mesh->Submesh());
      _out.key("center_submesh").boolean(mesh->CenterSubmesh());
      break;
    }
    case sdf::GeometryType::HEIGHTMAP:
    {
      const auto *map = _geometry->HeightmapShape();
      _out.key("type").string("heightmap").key("uri").string(map->Uri()).key("size");
      writeVector(_out, map->Size());
      _out.key("pos");
      writeVector(_out, map->Position());
      break;
    }
    default:
    {
      // Polyline and image have no class in libsdformat12: the element's name is all there is.
      std::string type = "empty";
      if (_geometry->Element() && _geometry->Element()->GetFirstElement())
        type = _geometry->Element()->GetFirstElement()->GetName();
      _out.key("type").string(type);
    }
  }
  _out.endObject();
}

inline void writeSensor(Json &_out, const sdf::Sensor &_sensor)
{
  _out.beginObject();
  _out.key("name").string(_sensor.Name());
  _out.key("type").string(_sensor.TypeStr());
  if (_sensor.Element())
    _out.key("type_xml").string(_sensor.Element()->Get<std::string>("type"));
  _out.key("pose");
  // The graph of libsdformat 12 has no vertex for the sensors of a joint; without relative_to the
  // written pose is already the one in the link or joint that holds the sensor.
  if (_sensor.PoseRelativeTo().empty())
    writePose(_out, _sensor.RawPose());
  else
    writeResolved(_out, _sensor.SemanticPose(), "");
  _out.key("update_rate").number(_sensor.UpdateRate());
  _out.endObject();
}

template <typename Shape>
void writeShape(Json &_out, const Shape &_shape)
{
  _out.beginObject();
  _out.key("name").string(_shape.Name()).key("pose");
  writeResolved(_out, _shape.SemanticPose(), "");
  _out.key("geometry");
  writeGeometry(_out, _shape.Geom());
  _out.endObject();
}

inline void writeLink(Json &_out, const sdf::Link &_link)
{
  const auto &inertial = _link.Inertial();
  const auto &m = inertial.MassMatrix();
  _out.beginObject();
  _out.key("name").string(_link.Name()).key("pose");
  writeResolved(_out, _link.SemanticPose(), "__model__");
  _out.key("mass").number(m.Mass());
  _out.key("inertial_pose");
  writePose(_out, inertial.Pose());
  _out.key("inertia").numbers({m.Ixx(), m.Ixy(), m.Ixz(), m.Iyy(), m.Iyz(), m.Izz()});
  _out.key("collisions").beginArray();
  for (uint64_t i = 0; i < _link.CollisionCount(); ++i)
    writeShape(_out, *_link.CollisionByIndex(i));
  _out.endArray().key("visuals").beginArray();
  for (uint64_t i = 0; i < _link.VisualCount(); ++i)
    writeShape(_out, *_link.VisualByIndex(i));
  _out.endArray().key("sensors").beginArray();
  for (uint64_t i = 0; i < _link.SensorCount(); ++i)
    writeSensor(_out, *_link.SensorByIndex(i));
  _out.endArray().key("lights").beginArray();
  for (uint64_t i = 0; i < _link.LightCount(); ++i)
    _out.string(_link.LightByIndex(i)->Name());
  _out.endArray().endObject();
}

inline void writeAxis(Json &_out, const sdf::JointAxis &_axis)
{
  Vector3d xyz_in_joint;
  _out.beginObject().key("xyz");
  // The default frame of ResolveXyz is the joint itself.
  if (_axis.ResolveXyz(xyz_in_joint).empty())
    writeVector(_out, xyz_in_joint);
  else
  {
    ++g_unresolved;
    _out.null();
  }
  _out.key("lower").number(_axis.Lower()).key("upper").number(_axis.Upper());
  _out.key("effort").number(_axis.Effort()).key("velocity").number(_axis.MaxVelocity());
  _out.key("damping").number(_axis.Damping()).key("friction").number(_axis.Friction());
  _out.endObject();
}

inline const char *jointTypeName(sdf::JointType _type)
{
  switch (_type)
  {
    case sdf::JointType::BALL: return "ball";
    case sdf::JointType::CONTINUOUS: return "continuous";
    case sdf::JointType::FIXED: return "fixed";
    case sdf::JointType::GEARBOX: return "gearbox";
    case sdf::JointType::PRISMATIC: return "prismatic";
    case sdf::JointType::REVOLUTE: return "revolute";
    case sdf::JointType::REVOLUTE2: return "revolute2";
    case sdf::JointType::SCREW: return "screw";
    case sdf::JointType::UNIVERSAL: return "universal";
    default: return "invalid";
  }
}

inline void writeJoint(Json &_out, const sdf::Joint &_joint)
{
  std::string parent_link, child_link;
  const bool parent_found = _joint.ResolveParentLink(parent_link).empty();
  const bool child_found = _joint.ResolveChildLink(child_link).empty();
  _out.beginObject();
  _out.key("name").string(_joint.Name());
  _out.key("type").string(jointTypeName(_joint.Type()));
  _out.key("parent").string(_joint.ParentLinkName());
  _out.key("child").string(_joint.ChildLinkName());
  _out.key("parent_link");
  if (parent_found) _out.string(parent_link); else _out.null();
  _out.key("child_link");
  if (child_found) _out.string(child_link); else _out.null();
  _out.key("pose");
  writeResolved(_out, _joint.SemanticPose(), "__model__");
  _out.key("axes").beginArray();
  for (unsigned i = 0; i < 2; ++i)
    if (_joint.Axis(i)) writeAxis(_out, *_joint.Axis(i));
  _out.endArray().key("sensors").beginArray();
  for (uint64_t i = 0; i < _joint.SensorCount(); ++i)
    writeSensor(_out, *_joint.SensorByIndex(i));
  _out.endArray().endObject();
}

template <typename Parent>
void writeFrames(Json &_out, const Parent &_parent, const std::string &_to)
{
  _out.key("frames").beginArray();
  for (uint64_t i = 0; i < _parent.FrameCount(); ++i)
  {
    const auto &frame = *_parent.FrameByIndex(i);
    _out.beginObject();
    _out.key("name").string(frame.Name());
    _out.key("attached_to").string(frame.AttachedTo());
    _out.key("pose");
    writeResolved(_out, frame.SemanticPose(), _to);
    _out.endObject();
  }
  _out.endArray();
}

inline void writeModel(Json &_out, const sdf::Model &_model, bool _is_root)
{
  _out.beginObject();
  _out.key("name").string(_model.Name());
  _out.key("static").boolean(_model.Static());
  _out.key("canonical_link").string(_model.CanonicalLinkAndRelativeName().second);
  _out.key("placement_frame").string(_model.PlacementFrameName());
  _out.key("pose");
  if (_is_root)
  {
    // A root model stands in no frame, so the graph may refuse; then its written pose is its pose.
    Pose3d pose;
    if (!_model.SemanticPose().Resolve(pose).empty()) pose = _model.RawPose();
    writePose(_out, pose);
  }
  else
    writeResolved(_out, _model.SemanticPose(), "");
  _out.key("links").beginArray();
  for (uint64_t i = 0; i < _model.LinkCount(); ++i) writeLink(_out, *_model.LinkByIndex(i));
  _out.endArray().key("joints").beginArray();
  for (uint64_t i = 0; i < _model.JointCount(); ++i) writeJoint(_out, *_model.JointByIndex(i));
  _out.endArray();
  writeFrames(_out, _model, "__model__");
  _out.key("models").beginArray();
  for (uint64_t i = 0; i < _model.ModelCount(); ++i)
    writeModel(_out, *_model.ModelByIndex(i), false);
  _out.endArray().endObject();
}

inline void writeWorld(Json &_out, const sdf::World &_world)
{
  _out.beginObject();
  _out.key("name").string(_world.Name());
  _out.key("gravity");
  writeVector(_out, _world.Gravity());
  _out.key("models").beginArray();
  for (uint64_t i = 0; i < _world.ModelCount(); ++i)
    writeModel(_out, *_world.ModelByIndex(i), false);
  _out.endArray().key("lights").beginArray();
  for (uint64_t i = 0; i < _world.LightCount(); ++i) _out.string(_world.LightByIndex(i)->Name());
  _out.endArray().key("actors").beginArray();
  for (uint64_t i = 0; i < _world.ActorCount(); ++i) _out.string(_world.ActorByIndex(i)->Name());
  _out.endArray();
  writeFrames(_out, _world, "world");
  _out.endObject();
}

inline void writeRoot(Json &_out, const sdf::Root &_root)
{
  _out.key("worlds").beginArray();
  for (uint64_t i = 0; i < _root.WorldCount(); ++i) writeWorld(_out, *_root.WorldByIndex(i));
  _out.endArray().key("models").beginArray();
  if (_root.Model()) writeModel(_out, *_root.Model(), true);
  _out.endArray().key("lights").beginArray();
  if (_root.Light()) _out.string(_root.Light()->Name());
  _out.endArray().key("actors").beginArray();
  if (_root.Actor()) _out.string(_root.Actor()->Name());
  _out.endArray();
}
