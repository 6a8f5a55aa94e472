// Rays in Embree, through its C interface: every packet width, with one thread.
//
// Usage: rays_embree SCENES SCENE OUT [DEVICE]. SCENES/SCENE.mesh and SCENES/rays/SCENE.LOAD.rays are
// the files of the ray bench: u32 vertices, u32 triangles, f32 positions, u32 corners; f32 origin and
// direction of each ray. DEVICE is passed to rtcNewDevice after `threads=1` (for instance `isa=avx2`).
// The answer is one JSON line for each load and width; the distances of each load go to
// OUT/c:embree.SCENE.LOAD.f32.
//
// Embree is given its best: build quality high, no robust flag, rays laid out in packets beforehand
// (the copy of a packet, which Embree writes its hit into, is counted), denormals flushed, and of the
// coherent and the incoherent flag the faster one. Compiles with Embree 3 and 4.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <time.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace {

constexpr int kMinRepeats = 3;
constexpr int kMaxRepeats = 15;
constexpr double kSecondsPerLoad = 0.8;
constexpr size_t kFewRays = 10000;  // repeated within a measurement
constexpr int kInnerRepeats = 20;

const char* const kLoads[] = {"lidar2d_360",   "lidar2d_1440",   "lidar3d_64x1024", "lidar3d_128x2048",
                              "depth_640x480", "batch_1024x360", "random",          "edges"};

[[noreturn]] void Fail(const std::string& why) {
  std::fprintf(stderr, "rays_embree: %s\n", why.c_str());
  std::exit(1);
}

double CpuSeconds() {
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double WallSeconds() {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

bool Read(const std::string& path, std::vector<char>* bytes) {
  FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return false;
  std::fseek(file, 0, SEEK_END);
  bytes->resize(static_cast<size_t>(std::ftell(file)));
  std::rewind(file);
  const bool whole = std::fread(bytes->data(), 1, bytes->size(), file) == bytes->size();
  std::fclose(file);
  return whole;
}

// One packet type of Embree. Arrays of length one stand for the scalar members of RTCRayHit.
template <int kWidth>
struct Wide;
template <>
struct Wide<1> {
  using Packet = RTCRayHit;
};
template <>
struct Wide<4> {
  using Packet = RTCRayHit4;
};
template <>
struct Wide<8> {
  using Packet = RTCRayHit8;
};
template <>
struct Wide<16> {
  using Packet = RTCRayHit16;
};

template <typename Member>
auto& Lane(Member& member, int lane) {
  if constexpr (std::is_array_v<Member>) {
    return member[lane];
  } else {
    return member;
  }
}

#if RTC_VERSION_MAJOR >= 4
struct Query {
  RTCRayQueryContext context;
  RTCIntersectArguments arguments;
  explicit Query(bool coherent) {
    rtcInitRayQueryContext(&context);
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    arguments.feature_mask = RTC_FEATURE_FLAG_TRIANGLE;
    arguments.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  }
  void Run(const int*, RTCScene scene, RTCRayHit* p) { rtcIntersect1(scene, p, &arguments); }
  void Run(const int* valid, RTCScene scene, RTCRayHit4* p) { rtcIntersect4(valid, scene, p, &arguments); }
  void Run(const int* valid, RTCScene scene, RTCRayHit8* p) { rtcIntersect8(valid, scene, p, &arguments); }
  void Run(const int* valid, RTCScene scene, RTCRayHit16* p) { rtcIntersect16(valid, scene, p, &arguments); }
};
#else
struct Query {
  RTCIntersectContext context;
  explicit Query(bool coherent) {
    rtcInitIntersectContext(&context);
    context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  void Run(const int*, RTCScene scene, RTCRayHit* p) { rtcIntersect1(scene, &context, p); }
  void Run(const int* valid, RTCScene scene, RTCRayHit4* p) { rtcIntersect4(valid, scene, &context, p); }
  void Run(const int* valid, RTCScene scene, RTCRayHit8* p) { rtcIntersect8(valid, scene, &context, p); }
  void Run(const int* valid, RTCScene scene, RTCRayHit16* p) { rtcIntersect16(valid, scene, &context, p); }
};
#endif

template <int kWidth>
class Race {
 public:
  using Packet = typename Wide<kWidth>::Packet;

  Race(const float* rays, size_t count) : count_(count), packets_((count + kWidth - 1) / kWidth) {
    for (size_t number = 0; number < packets_.size(); ++number) {
      Packet& packet = packets_[number];
      std::memset(&packet, 0, sizeof(packet));
      for (int lane = 0; lane < kWidth; ++lane) {
        const size_t index = number * kWidth + static_cast<size_t>(lane);
        const float* ray = rays + 6 * std::min(index, count - 1);
        Lane(packet.ray.org_x, lane) = ray[0];
        Lane(packet.ray.org_y, lane) = ray[1];
        Lane(packet.ray.org_z, lane) = ray[2];
        Lane(packet.ray.dir_x, lane) = ray[3];
        Lane(packet.ray.dir_y, lane) = ray[4];
        Lane(packet.ray.dir_z, lane) = ray[5];
        Lane(packet.ray.tfar, lane) = std::numeric_limits<float>::infinity();
        Lane(packet.ray.mask, lane) = ~0u;
        Lane(packet.hit.geomID, lane) = RTC_INVALID_GEOMETRY_ID;
        Lane(packet.hit.primID, lane) = RTC_INVALID_GEOMETRY_ID;
        Lane(packet.hit.instID[0], lane) = RTC_INVALID_GEOMETRY_ID;
      }
    }
  }

  // Casts all rays once. Without a hit Embree leaves the distance infinite.
  void Cast(RTCScene scene, bool coherent, float* distances) const {
    Query query(coherent);
    alignas(64) int valid[16];
    std::fill(valid, valid + 16, -1);
    size_t index = 0;
    for (const Packet& packet : packets_) {
      Packet own = packet;
      query.Run(valid, scene, &own);
      if (index + kWidth <= count_) {
        std::memcpy(distances + index, &own.ray.tfar, kWidth * sizeof(float));
      } else {
        std::memcpy(distances + index, &own.ray.tfar, (count_ - index) * sizeof(float));
      }
      index += kWidth;
    }
  }

 private:
  size_t count_;
  std::vector<Packet> packets_;
};

struct Times {
  double wall_s, cpu_s, best_s;
};

template <int kWidth>
Times Measure(const Race<kWidth>& race, RTCScene scene, bool coherent, std::vector<float>* distances) {
  const int inner = distances->size() < kFewRays ? kInnerRepeats : 1;
  std::vector<double> walls, cpus;
  race.Cast(scene, coherent, distances->data());
  const double begin = WallSeconds();
  while (static_cast<int>(walls.size()) < kMinRepeats ||
         (static_cast<int>(walls.size()) < kMaxRepeats && WallSeconds() - begin < kSecondsPerLoad)) {
    const double start = WallSeconds(), cpu = CpuSeconds();
    for (int i = 0; i < inner; ++i) race.Cast(scene, coherent, distances->data());
    walls.push_back((WallSeconds() - start) / inner);
    cpus.push_back((CpuSeconds() - cpu) / inner);
  }
  std::sort(walls.begin(), walls.end());
  std::sort(cpus.begin(), cpus.end());
  return {walls[walls.size() / 2], cpus[cpus.size() / 2], walls[0]};
}

// Measures one width over one load, prints its line.
template <int kWidth>
void Run(RTCScene scene, const std::string& name, const char* load, const std::vector<float>& rays, double build_ms,
         std::vector<float>* distances) {
  const size_t count = rays.size() / 6;
  const Race<kWidth> race(rays.data(), count);
  Times best = Measure(race, scene, false, distances);
  bool coherent = false;
  const Times other = Measure(race, scene, true, distances);
  if (other.cpu_s < best.cpu_s) {
    best = other;
    coherent = true;
  }
  size_t hits = 0;
  for (const float distance : *distances) hits += std::isfinite(distance);
  const double million = static_cast<double>(count) / 1e6;
  std::printf(
      "{\"peer\":\"c:embree\",\"version\":\"%s\",\"width\":%d,\"coherent\":%s,\"scene\":\"%s\",\"load\":\"%s\","
      "\"threads\":1,\"rays\":%zu,\"mrays_per_s\":%.6g,\"mrays_cpu\":%.6g,\"mrays_best\":%.6g,\"build_ms\":%.6g,"
      "\"hits\":%zu}\n",
      RTC_VERSION_STRING, kWidth, coherent ? "true" : "false", name.c_str(), load, count, million / best.wall_s,
      million / best.cpu_s, million / best.best_s, build_ms, hits);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4 || argc > 5) Fail("usage: rays_embree SCENES SCENE OUT [DEVICE]");
  const std::string scenes = argv[1], name = argv[2], out = argv[3];
  // Embree's manual asks for both; without them denormals are slow.
  _mm_setcsr(_mm_getcsr() | 0x8040);
  const std::string config = std::string("threads=1") + (argc == 5 ? std::string(",") + argv[4] : "");
  RTCDevice device = rtcNewDevice(config.c_str());
  if (!device) Fail("Embree gives no device");

  std::vector<char> mesh;
  if (!Read(scenes + "/" + name + ".mesh", &mesh) || mesh.size() < 8) Fail("cannot read the mesh of " + name);
  uint32_t counts[2];
  std::memcpy(counts, mesh.data(), sizeof(counts));
  const size_t positions = size_t{12} * counts[0], corners = size_t{12} * counts[1];
  if (mesh.size() != 8 + positions + corners) Fail("the mesh of " + name + " has another length");

  const double start = WallSeconds();
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* to = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, counts[0]);
  std::memcpy(to, mesh.data() + 8, positions);
  to = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, counts[1]);
  std::memcpy(to, mesh.data() + 8 + positions, corners);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_NONE);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  const double build_ms = 1e3 * (WallSeconds() - start);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) Fail("Embree reports an error");

  for (const char* load : kLoads) {
    std::vector<char> bytes;
    if (!Read(scenes + "/rays/" + name + "." + load + ".rays", &bytes) || bytes.empty()) continue;
    std::vector<float> rays(bytes.size() / 4);
    std::memcpy(rays.data(), bytes.data(), rays.size() * 4);
    std::vector<float> distances(rays.size() / 6);
    Run<4>(scene, name, load, rays, build_ms, &distances);
    Run<8>(scene, name, load, rays, build_ms, &distances);
    Run<16>(scene, name, load, rays, build_ms, &distances);
    Run<1>(scene, name, load, rays, build_ms, &distances);
    const std::string path = out + "/c:embree." + name + "." + load + ".f32";
    FILE* file = std::fopen(path.c_str(), "wb");
    if (!file) Fail("cannot write " + path);
    const bool whole = std::fwrite(distances.data(), 4, distances.size(), file) == distances.size();
    if (std::fclose(file) != 0 || !whole) Fail("cannot write " + path);
  }
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
  return 0;
}
