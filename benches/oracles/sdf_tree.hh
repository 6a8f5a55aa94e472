// The element tree of libsdformat as JSON: names, and poses as written, none resolved.

#pragma once

#include <string>
#include <vector>

#include <sdf/sdf.hh>

#include "sdf_values.hh"

inline std::vector<sdf::ElementPtr> children(const sdf::ElementPtr &_elem, const std::string &_tag)
{
  std::vector<sdf::ElementPtr> found;
  if (!_elem || !_elem->HasElement(_tag)) return found;
  for (auto e = _elem->GetElement(_tag); e; e = e->GetNextElement(_tag)) found.push_back(e);
  return found;
}

inline std::string attribute(const sdf::ElementPtr &_elem, const std::string &_name)
{
  const auto param = _elem->GetAttribute(_name);
  return param ? param->GetAsString() : "";
}

inline void writeRawPose(Json &_out, const sdf::ElementPtr &_elem)
{
  Pose3d pose;
  std::string relative_to;
  if (_elem->HasElement("pose"))
  {
    auto element = _elem->GetElement("pose");
    pose = element->Get<Pose3d>();
    relative_to = attribute(element, "relative_to");
  }
  _out.key("raw_pose");
  writePose(_out, pose);
  _out.key("relative_to").string(relative_to);
}

inline void writeNames(Json &_out, const sdf::ElementPtr &_elem, const std::string &_tag)
{
  _out.beginArray();
  for (const auto &e : children(_elem, _tag)) _out.string(attribute(e, "name"));
  _out.endArray();
}

inline void writeRawSensors(Json &_out, const sdf::ElementPtr &_elem)
{
  _out.key("sensors").beginArray();
  for (const auto &e : children(_elem, "sensor"))
  {
    _out.beginObject().key("name").string(attribute(e, "name"));
    _out.key("type_xml").string(attribute(e, "type"));
    writeRawPose(_out, e);
    _out.endObject();
  }
  _out.endArray();
}

inline void writeRawShapes(Json &_out, const sdf::ElementPtr &_elem, const std::string &_tag)
{
  _out.beginArray();
  for (const auto &e : children(_elem, _tag))
  {
    std::string type = "none";
    if (e->HasElement("geometry"))
    {
      auto shape = e->GetElement("geometry")->GetFirstElement();
      type = shape ? shape->GetName() : "empty";
    }
    _out.beginObject().key("name").string(attribute(e, "name"));
    writeRawPose(_out, e);
    _out.key("geometry").beginObject().key("type").string(type).endObject().endObject();
  }
  _out.endArray();
}

inline void writeRawModel(Json &_out, const sdf::ElementPtr &_model)
{
  _out.beginObject();
  _out.key("name").string(attribute(_model, "name"));
  _out.key("static").boolean(_model->HasElement("static") && _model->Get<bool>("static"));
  _out.key("canonical_link").string(attribute(_model, "canonical_link"));
  _out.key("placement_frame").string(attribute(_model, "placement_frame"));
  writeRawPose(_out, _model);
  _out.key("links").beginArray();
  for (const auto &link : children(_model, "link"))
  {
    _out.beginObject().key("name").string(attribute(link, "name"));
    writeRawPose(_out, link);
    _out.key("collisions");
    writeRawShapes(_out, link, "collision");
    _out.key("visuals");
    writeRawShapes(_out, link, "visual");
    writeRawSensors(_out, link);
    _out.key("lights");
    writeNames(_out, link, "light");
    _out.endObject();
  }
  _out.endArray().key("joints").beginArray();
  for (const auto &joint : children(_model, "joint"))
  {
    _out.beginObject().key("name").string(attribute(joint, "name"));
    _out.key("type").string(attribute(joint, "type"));
    for (const char *end : {"parent", "child"})
      _out.key(end).string(joint->HasElement(end) ? joint->Get<std::string>(end) : "");
    writeRawPose(_out, joint);
    writeRawSensors(_out, joint);
    _out.endObject();
  }
  _out.endArray().key("frames").beginArray();
  for (const auto &frame : children(_model, "frame"))
  {
    _out.beginObject().key("name").string(attribute(frame, "name"));
    _out.key("attached_to").string(attribute(frame, "attached_to"));
    writeRawPose(_out, frame);
    _out.endObject();
  }
  _out.endArray().key("models").beginArray();
  for (const auto &nested : children(_model, "model")) writeRawModel(_out, nested);
  _out.endArray().endObject();
}

inline void writeRawRoot(Json &_out, const sdf::ElementPtr &_root)
{
  _out.key("worlds").beginArray();
  for (const auto &world : children(_root, "world"))
  {
    _out.beginObject().key("name").string(attribute(world, "name"));
    _out.key("gravity");
    Vector3d gravity(0, 0, -9.8);
    if (world->HasElement("gravity")) gravity = world->Get<Vector3d>("gravity");
    writeVector(_out, gravity);
    _out.key("models").beginArray();
    for (const auto &model : children(world, "model")) writeRawModel(_out, model);
    _out.endArray().key("lights");
    writeNames(_out, world, "light");
    _out.key("actors");
    writeNames(_out, world, "actor");
    _out.key("frames").beginArray().endArray().endObject();
  }
  _out.endArray().key("models").beginArray();
  for (const auto &model : children(_root, "model")) writeRawModel(_out, model);
  _out.endArray().key("lights");
  writeNames(_out, _root, "light");
  _out.key("actors");
  writeNames(_out, _root, "actor");
}
