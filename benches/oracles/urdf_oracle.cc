// Reads names of URDF files (already expanded) on stdin, prints one JSON line a file: the tree
// that liburdfdom, the library behind check_urdf, builds of it.
//
// Each file is parsed in a child process with a time limit, so a crash costs one line. The fields
// are in README.md beside this file. `--bench` parses all in this process and prints the seconds.

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "child_process.hh"
#include "json_writer.hh"

namespace
{
void writePose(Json &_out, const urdf::Pose &_pose)
{
  const auto &p = _pose.position;
  const auto &q = _pose.rotation;
  const double lead = q.w != 0 ? q.w : q.x != 0 ? q.x : q.y != 0 ? q.y : q.z;
  const double sign = lead < 0 ? -1 : 1;
  _out.numbers({p.x, p.y, p.z, sign * q.w, sign * q.x, sign * q.y, sign * q.z});
}

void writeGeometry(Json &_out, const urdf::GeometrySharedPtr &_geometry)
{
  _out.beginObject();
  if (!_geometry)
    _out.key("type").string("none");
  else if (_geometry->type == urdf::Geometry::BOX)
  {
    const auto &size = static_cast<const urdf::Box &>(*_geometry).dim;
    _out.key("type").string("box").key("size").numbers({size.x, size.y, size.z});
  }
  else if (_geometry->type == urdf::Geometry::CYLINDER)
  {
    const auto &cylinder = static_cast<const urdf::Cylinder &>(*_geometry);
    _out.key("type").string("cylinder").key("radius").number(cylinder.radius);
    _out.key("length").number(cylinder.length);
  }
  else if (_geometry->type == urdf::Geometry::SPHERE)
  {
    _out.key("type").string("sphere").key("radius");
    _out.number(static_cast<const urdf::Sphere &>(*_geometry).radius);
  }
  else
  {
    const auto &mesh = static_cast<const urdf::Mesh &>(*_geometry);
    _out.key("type").string("mesh").key("uri").string(mesh.filename);
    _out.key("scale").numbers({mesh.scale.x, mesh.scale.y, mesh.scale.z});
  }
  _out.endObject();
}

template <typename Shape>
void writeShapes(Json &_out, const std::vector<Shape> &_shapes)
{
  _out.beginArray();
  for (const auto &shape : _shapes)
  {
    _out.beginObject().key("name").string(shape->name).key("pose");
    writePose(_out, shape->origin);
    _out.key("geometry");
    writeGeometry(_out, shape->geometry);
    _out.endObject();
  }
  _out.endArray();
}

void writeLink(Json &_out, const urdf::Link &_link)
{
  _out.beginObject().key("name").string(_link.name).key("parent");
  if (_link.getParent()) _out.string(_link.getParent()->name); else _out.null();
  if (_link.inertial)
  {
    const auto &i = *_link.inertial;
    _out.key("mass").number(i.mass).key("inertial_pose");
    writePose(_out, i.origin);
    _out.key("inertia").numbers({i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz});
  }
  else
    _out.key("mass").null();
  _out.key("collisions");
  writeShapes(_out, _link.collision_array);
  _out.key("visuals");
  writeShapes(_out, _link.visual_array);
  _out.endObject();
}

const char *jointTypeName(int _type)
{
  switch (_type)
  {
    case urdf::Joint::REVOLUTE: return "revolute";
    case urdf::Joint::CONTINUOUS: return "continuous";
    case urdf::Joint::PRISMATIC: return "prismatic";
    case urdf::Joint::FLOATING: return "floating";
    case urdf::Joint::PLANAR: return "planar";
    case urdf::Joint::FIXED: return "fixed";
    default: return "unknown";
  }
}

void writeJoint(Json &_out, const urdf::Joint &_joint)
{
  _out.beginObject().key("name").string(_joint.name);
  _out.key("type").string(jointTypeName(_joint.type));
  _out.key("parent").string(_joint.parent_link_name);
  _out.key("child").string(_joint.child_link_name).key("pose");
  writePose(_out, _joint.parent_to_joint_origin_transform);
  _out.key("axis").numbers({_joint.axis.x, _joint.axis.y, _joint.axis.z}).key("limits");
  if (_joint.limits)
  {
    const auto &l = *_joint.limits;
    _out.beginObject().key("lower").number(l.lower).key("upper").number(l.upper);
    _out.key("effort").number(l.effort).key("velocity").number(l.velocity).endObject();
  }
  else
    _out.null();
  _out.key("dynamics");
  if (_joint.dynamics)
    _out.beginObject().key("damping").number(_joint.dynamics->damping)
        .key("friction").number(_joint.dynamics->friction).endObject();
  else
    _out.null();
  _out.key("mimic");
  if (_joint.mimic)
    _out.beginObject().key("joint").string(_joint.mimic->joint_name)
        .key("multiplier").number(_joint.mimic->multiplier)
        .key("offset").number(_joint.mimic->offset).endObject();
  else
    _out.null();
  _out.endObject();
}

std::string describe(const std::string &_file)
{
  std::FILE *console = std::tmpfile();
  if (console)
  {
    dup2(fileno(console), STDERR_FILENO);
    dup2(fileno(console), STDOUT_FILENO);
  }
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDFFile(_file);
  Json out;
  out.beginObject().key("file").string(_file).key("ok").boolean(model != nullptr);
  if (model)
  {
    out.key("name").string(model->getName());
    out.key("root").string(model->getRoot()->name);
    // Maps of the library: by name, not in the order of the file.
    out.key("links").beginArray();
    for (const auto &[name, link] : model->links_) writeLink(out, *link);
    out.endArray().key("joints").beginArray();
    for (const auto &[name, joint] : model->joints_) writeJoint(out, *joint);
    out.endArray();
  }
  std::cout << std::flush;
  std::fflush(nullptr);
  std::string text;
  if (console)
  {
    std::rewind(console);
    char buffer[4096];
    const std::size_t n = std::fread(buffer, 1, sizeof buffer, console);
    text.assign(buffer, n);
  }
  return out.key("console").string(text).endObject().text();
}

/// The line for a file, whatever becomes of the process that makes it.
std::string answer(const std::string &_file)
{
  const ChildAnswer answer = inChild([&_file] { return describe(_file); });
  if (answer.crash.empty()) return answer.text;
  Json out;
  out.beginObject().key("file").string(_file).key("ok").boolean(false);
  return out.key("crash").string(answer.crash).endObject().text();
}

int bench(const std::vector<std::string> &_files)
{
  const int sink = open("/dev/null", O_WRONLY), real_stdout = dup(STDOUT_FILENO);
  dup2(sink, STDOUT_FILENO);
  dup2(sink, STDERR_FILENO);
  int loaded = 0;
  const auto start = std::chrono::steady_clock::now();
  for (const auto &file : _files)
    if (urdf::parseURDFFile(file)) ++loaded;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  std::cout << std::flush;
  dup2(real_stdout, STDOUT_FILENO);
  Json out;
  out.beginObject().key("files").number(static_cast<double>(_files.size()));
  out.key("loaded_without_error").number(loaded).key("seconds").number(spent.count());
  std::cout << out.endObject().text() << "\n";
  return 0;
}
}  // namespace

int main(int argc, char **argv)
{
  std::vector<std::string> files;
  for (std::string line; std::getline(std::cin, line);)
    if (!line.empty()) files.push_back(line);
  if (argc > 1 && std::string(argv[1]) == "--bench") return bench(files);
  for (const auto &file : files) std::cout << answer(file) << "\n" << std::flush;
  return 0;
}
