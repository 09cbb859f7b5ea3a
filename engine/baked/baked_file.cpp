// Layout: FORMAT.md. Sections are coded to bytes first, then placed; reading checks sizes and checksums before it
// takes memory or believes a number.
#include "engine/baked/baked_file.h"

#include <xxhash.h>
#include <zstd.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <memory>
#include <span>
#include <type_traits>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "shaders/shared/sh.h"

namespace daylit {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian and copied as it lies in memory");

using Bytes = std::vector<std::uint8_t>;
using Path = std::filesystem::path;

constexpr std::array<char, 8> kMagic = {'D', 'A', 'Y', 'L', 'I', 'T', '\r', '\n'};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 32, kEntryBytes = 48;
constexpr std::uint32_t kMaxSections = 64, kMaxString = 65536, kMaxPlanItems = 256;
constexpr std::uint32_t kMaxComponents = 64, kMaxKeyframes = 4096, kMaxSide = 16384;
constexpr std::uint32_t kMaxProbesPerSide = 4096;
constexpr std::uint64_t kMaxSectionBytes = std::uint64_t(1) << 30;
constexpr std::size_t kSmallSectionBytes = std::size_t(32) << 20;  // of settings, plan and time basis
constexpr int kZstdLevel = 6;  // texels: within 2 % of level 12 in size, at a fifth of its time

class Writer {
  public:
    template <class T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
        bytes_.insert(bytes_.end(), bytes, bytes + sizeof(T));
    }
    template <class T>
    void put_all(const std::vector<T>& values) {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
        bytes_.insert(bytes_.end(), bytes, bytes + values.size() * sizeof(T));
    }
    void put_string(const std::string& text) {
        const std::string kept = text.substr(0, kMaxString);
        put(std::uint32_t(kept.size()));
        bytes_.insert(bytes_.end(), kept.begin(), kept.end());
    }
    Bytes take() { return std::move(bytes_); }

  private:
    Bytes bytes_;
};

/// Reads one section's bytes; every step is checked against their end.
class Reader {
  public:
    Reader(std::span<const std::uint8_t> bytes, const Path& path, std::string place)
        : bytes_(bytes), path_(path), place_(std::move(place)) {}

    template <class T>
    T get() {
        T value;
        std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
        return value;
    }
    template <class T>
    std::vector<T> get_all(std::size_t count) {
        if (count > bytes_.size() / sizeof(T)) fail("ends too early");
        std::vector<T> values(count);
        if (count) std::memcpy(values.data(), take(count * sizeof(T)).data(), count * sizeof(T));
        return values;
    }
    double finite() {
        const double value = get<double>();
        if (!std::isfinite(value)) fail("holds a number that is not finite");
        return value;
    }
    Vec3 finite_vec3() {
        const Vec3 v = get<Vec3>();
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
            fail("holds a number that is not finite");
        return v;
    }
    bool boolean() { return number(std::uint8_t(0), std::uint8_t(1), "a boolean") == 1; }
    template <class T>
    T number(T least, T most, const char* what) {
        const T value = get<T>();
        if (value < least || value > most) fail(std::string(what) + " is out of range");
        return value;
    }
    std::string string() {
        const auto text = take(number<std::uint32_t>(0, kMaxString, "a string's length"));
        return {text.begin(), text.end()};
    }
    void expect_end() {
        if (!bytes_.empty()) fail("is longer than what it holds");
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(path_.string(), place_ + " " + what + "; bake the scene again");
    }

  private:
    std::span<const std::uint8_t> take(std::size_t count) {
        if (count > bytes_.size()) fail("ends too early");
        const auto taken = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return taken;
    }

    std::span<const std::uint8_t> bytes_;
    const Path& path_;
    std::string place_;
};

// ---- sections ----

Bytes code_settings(const Baked& baked) {
    Writer w;
    const LightSettings& light = baked.light;
    w.put(light.day.latitude), w.put(light.day.longitude);
    w.put(std::int32_t(light.day.date.year)), w.put(std::int32_t(light.day.date.month));
    w.put(std::int32_t(light.day.date.day));
    w.put(light.day.utc_offset), w.put(light.day.north);
    w.put(std::uint8_t(light.sun)), w.put(std::uint8_t(light.sky));
    w.put(light.sun_direction), w.put(light.sun_illuminance);
    w.put_string(light.sky_file.string());
    w.put(light.sky_radiance);
    w.put(light.turbidity), w.put(light.clouds);
    w.put(baked.unit);
    w.put(std::uint8_t(baked.lambert));
    w.put(baked.geometry_hash);
    return w.take();
}

void decode_settings(Reader r, Baked& baked) {
    LightSettings& light = baked.light;
    light.day.latitude = r.finite(), light.day.longitude = r.finite();
    light.day.date.year = r.number<std::int32_t>(-10000, 10000, "the year");
    light.day.date.month = r.number<std::int32_t>(1, 12, "the month");
    light.day.date.day = r.number<std::int32_t>(1, 31, "the day");
    light.day.utc_offset = r.finite(), light.day.north = r.finite();
    light.sun = SunSource(r.number<std::uint8_t>(0, std::uint8_t(SunSource::Given), "the sun's source"));
    light.sky = SkySource(r.number<std::uint8_t>(0, std::uint8_t(SkySource::Constant), "the sky's source"));
    light.sun_direction = r.finite_vec3(), light.sun_illuminance = r.finite_vec3();
    light.sky_file = r.string();
    light.sky_radiance = r.finite_vec3();
    light.turbidity = r.finite(), light.clouds = r.finite();
    baked.unit = r.finite();
    baked.lambert = r.boolean();
    baked.geometry_hash = r.get<std::uint64_t>();
    r.expect_end();
}

Bytes code_plan(const std::vector<PlanItem>& plan) {
    Writer w;
    w.put(std::uint32_t(plan.size()));
    for (const PlanItem& item : plan) {
        w.put_string(item.part);
        w.put(std::uint8_t(item.done));
        w.put_string(item.why);
        w.put(item.bytes);
        w.put(item.error);
    }
    return w.take();
}

void decode_plan(Reader r, Baked& baked) {
    baked.plan.resize(r.number<std::uint32_t>(0, kMaxPlanItems, "the number of parts"));
    for (PlanItem& item : baked.plan) {
        item.part = r.string();
        item.done = r.boolean();
        item.why = r.string();
        item.bytes = r.get<std::uint64_t>();
        item.error = r.finite();
    }
    r.expect_end();
}

void code_curves(const DayBasis& basis, Writer& w) {
    w.put_all(basis.hours);
    w.put_all(basis.curves);
}

/// Hours and curves of a basis whose number of components is known.
void decode_curves(Reader& r, std::size_t keyframes, DayBasis& basis) {
    basis.hours = r.get_all<double>(keyframes);
    for (std::size_t i = 0; i < keyframes; ++i) {
        const double hour = basis.hours[i];
        if (!(hour >= 0.0 && hour <= 24.0) || (i > 0 && hour <= basis.hours[i - 1]))
            r.fail("has hours that do not ascend from 0 to 24");
    }
    basis.curves = r.get_all<float>(std::size_t(basis.components) * keyframes);
    for (float weight : basis.curves)
        if (!std::isfinite(weight)) r.fail("holds a weight that is not finite");
}

std::vector<std::uint16_t> finite_halves(Reader& r, std::size_t count, const char* what) {
    std::vector<std::uint16_t> halves = r.get_all<std::uint16_t>(count);
    for (std::uint16_t half : halves)
        if ((half & 0x7C00u) == 0x7C00u) r.fail(std::string("holds a ") + what + " that is not finite");
    r.expect_end();
    return halves;
}

Bytes code_lightmap(const DayLightmap& map) {
    Writer w;
    w.put(std::uint32_t(map.width)), w.put(std::uint32_t(map.height));
    w.put(std::uint32_t(map.basis.components)), w.put(std::uint32_t(map.basis.hours.size()));
    w.put(std::uint32_t(map.corner_uvs.size()));
    code_curves(map.basis, w);
    return w.take();
}

/// Returns the number of corners that LMUV must hold.
std::size_t decode_lightmap(Reader r, DayLightmap& map) {
    map.width = int(r.number<std::uint32_t>(1, kMaxSide, "the lightmap's width"));
    map.height = int(r.number<std::uint32_t>(1, kMaxSide, "the lightmap's height"));
    map.basis.components = int(r.number<std::uint32_t>(0, kMaxComponents, "the number of components"));
    const std::size_t keyframes = r.number<std::uint32_t>(1, kMaxKeyframes, "the number of keyframes");
    const std::size_t corners = r.get<std::uint32_t>();
    if (corners % 3 != 0) r.fail("counts corners that are not three per triangle");
    decode_curves(r, keyframes, map.basis);
    r.expect_end();
    return corners;
}

void decode_corner_uvs(Reader r, std::size_t corners, DayLightmap& map) {
    map.corner_uvs = r.get_all<Vec2>(corners);
    for (const Vec2& uv : map.corner_uvs)
        if (!(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f)) r.fail("leaves the atlas");
    r.expect_end();
}

std::size_t texel_halves(const DayLightmap& map) {
    return 3 * std::size_t(map.width) * std::size_t(map.height) * std::size_t(map.basis.components);
}

void decode_texels(Reader r, DayLightmap& map) {
    map.components = finite_halves(r, texel_halves(map), "texel");
}

Bytes code_volume(const IrradianceVolume& volume) {
    Writer w;
    w.put(volume.origin), w.put(volume.spacing);
    for (int side : volume.size) w.put(std::uint32_t(side));
    w.put(std::uint32_t(volume.basis.components)), w.put(std::uint32_t(volume.basis.hours.size()));
    code_curves(volume.basis, w);
    return w.take();
}

void decode_volume(Reader r, IrradianceVolume& volume) {
    volume.origin = r.finite_vec3();
    volume.spacing = r.get<float>();
    if (!(volume.spacing > 0.0f && std::isfinite(volume.spacing))) r.fail("has no spacing");
    for (int& side : volume.size) side = int(r.number<std::uint32_t>(1, kMaxProbesPerSide, "the number of probes along a side"));
    volume.basis.components = int(r.number<std::uint32_t>(0, kMaxComponents, "the number of components"));
    decode_curves(r, r.number<std::uint32_t>(1, kMaxKeyframes, "the number of keyframes"), volume.basis);
    r.expect_end();
}

std::size_t probe_halves(const IrradianceVolume& volume) {
    return 3 * std::size_t(glsl::kShCoefficients) * volume.probes() * std::size_t(volume.basis.components);
}

// ---- the file around them ----

struct Section {
    std::array<char, 4> name;
    std::uint32_t coding = 0;
    std::uint64_t offset = 0, stored = 0, decoded = 0, hash = 0, zero = 0;
};
static_assert(sizeof(Section) == kEntryBytes);

std::string quoted(const Section& section) {
    return "section '" + std::string(section.name.begin(), section.name.end()) + "'";
}

struct Payload {
    Section entry;
    Bytes bytes;
};

Payload compress(const char (&name)[5], const Bytes& raw) {
    Payload p;
    std::memcpy(p.entry.name.data(), name, 4);
    p.entry.coding = 1;
    p.entry.decoded = raw.size();
    p.bytes.resize(ZSTD_compressBound(raw.size()));
    const std::size_t size = ZSTD_compress(p.bytes.data(), p.bytes.size(), raw.data(), raw.size(), kZstdLevel);
    if (ZSTD_isError(size)) throw Error(std::string("cannot compress a section: ") + ZSTD_getErrorName(size));
    p.bytes.resize(size);
    p.entry.stored = size;
    p.entry.hash = XXH64(p.bytes.data(), p.bytes.size(), 0);
    return p;
}

template <class T>
Bytes raw_bytes(const std::vector<T>& values) {
    Writer w;
    w.put_all(values);
    return w.take();
}

/// The plan with each part's share of the file.
std::vector<PlanItem> with_bytes(std::vector<PlanItem> plan, const std::vector<Payload>& lightmap,
                                 const std::vector<Payload>& volume) {
    for (PlanItem& item : plan) {
        item.bytes = 0;
        for (const auto& [part, payloads] : {std::pair("lightmap", &lightmap), std::pair("volume", &volume)})
            if (item.part == part)
                for (const Payload& p : *payloads) item.bytes += p.entry.stored;
    }
    return plan;
}

/// xxHash64 over several stretches of memory in turn.
class Hash {
  public:
    Hash() : state_(XXH64_createState(), XXH64_freeState) { XXH64_reset(state_.get(), 0); }
    void add(const void* data, std::size_t bytes) {
        if (bytes) XXH64_update(state_.get(), data, bytes);
    }
    std::uint64_t value() const { return XXH64_digest(state_.get()); }

  private:
    std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> state_;
};

std::uint64_t header_hash(std::span<const std::uint8_t> file, std::size_t table_bytes) {
    Hash hash;
    hash.add(file.data(), 24);
    hash.add(file.data() + kHeaderBytes, table_bytes);
    return hash.value();
}

Bytes assemble(std::vector<Payload> payloads) {
    std::uint64_t end = kHeaderBytes + kEntryBytes * payloads.size();
    Writer w;
    for (Payload& p : payloads) {
        p.entry.offset = end;
        end += p.entry.stored;
    }
    w.put(kMagic), w.put(kVersion), w.put(std::uint32_t(payloads.size())), w.put(end), w.put(std::uint64_t(0));
    for (const Payload& p : payloads) w.put(p.entry);
    for (const Payload& p : payloads) w.put_all(p.bytes);
    Bytes file = w.take();
    const std::uint64_t hash = header_hash(file, kEntryBytes * payloads.size());
    std::memcpy(file.data() + 24, &hash, sizeof hash);
    return file;
}

template <class T>
T load(std::span<const std::uint8_t> file, std::size_t offset) {
    T value;
    std::memcpy(&value, file.data() + offset, sizeof(T));
    return value;
}

/// The section table, with every promise of the header and the table checked.
std::vector<Section> read_table(std::span<const std::uint8_t> file, const Path& path) {
    const auto refuse = [&](const std::string& what) { throw Error(path.string(), what + "; bake the scene again"); };
    if (file.size() < kHeaderBytes || load<std::array<char, 8>>(file, 0) != kMagic) refuse("is not a .daylit file");
    const auto version = load<std::uint32_t>(file, 8), count = load<std::uint32_t>(file, 12);
    if (version != kVersion)
        refuse("has version " + std::to_string(version) + " of the format, this program reads " +
               std::to_string(kVersion));
    if (load<std::uint64_t>(file, 16) != file.size())
        refuse("is " + std::to_string(file.size()) + " bytes long, its header says " +
               std::to_string(load<std::uint64_t>(file, 16)));
    if (count > kMaxSections || file.size() < kHeaderBytes + kEntryBytes * count) refuse("has a damaged header");
    if (load<std::uint64_t>(file, 24) != header_hash(file, kEntryBytes * count)) refuse("has a damaged header");

    std::vector<Section> sections;
    std::uint64_t end = kHeaderBytes + kEntryBytes * count;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto s = load<Section>(file, kHeaderBytes + kEntryBytes * i);
        if (s.offset != end || s.stored > file.size() - end) refuse(quoted(s) + " lies outside the file");
        if (s.coding > 1 || s.decoded > kMaxSectionBytes || (s.coding == 0 && s.decoded != s.stored))
            refuse(quoted(s) + " is coded in an unknown way");
        end += s.stored;
        sections.push_back(s);
    }
    if (end != file.size()) refuse("has bytes after its last section");
    return sections;
}

Bytes decode(std::span<const std::uint8_t> file, const Section& section, const Path& path) {
    const auto stored = file.subspan(section.offset, section.stored);
    const auto refuse = [&] { throw Error(path.string(), quoted(section) + " is damaged; bake the scene again"); };
    if (XXH64(stored.data(), stored.size(), 0) != section.hash) refuse();
    if (section.coding == 0) return {stored.begin(), stored.end()};
    if (ZSTD_getFrameContentSize(stored.data(), stored.size()) != section.decoded) refuse();
    Bytes raw(section.decoded);
    const std::size_t size = ZSTD_decompress(raw.data(), raw.size(), stored.data(), stored.size());
    if (ZSTD_isError(size) || size != raw.size()) refuse();
    return raw;
}

const Section* find(const std::vector<Section>& sections, const char* name) {
    for (const Section& s : sections)
        if (std::memcmp(s.name.data(), name, 4) == 0) return &s;
    return nullptr;
}

}  // namespace

std::uint64_t geometry_hash(const WorldMesh& mesh) {
    Hash hash;
    const auto add = [&](const auto& values) {
        const std::uint64_t count = values.size();
        hash.add(&count, sizeof count);
        hash.add(values.data(), count * sizeof(values[0]));
    };
    add(mesh.positions);
    add(mesh.normals);
    add(mesh.indices);
    return hash.value();
}

Baked read_baked(const Path& path) {
    const Bytes file = read_file(path);
    const std::vector<Section> sections = read_table(file, path);
    Bytes raw;  // of the section being read
    const auto open = [&](const char* name, std::size_t most = kSmallSectionBytes) {
        const Section* section = find(sections, name);
        if (!section)
            throw Error(path.string(), std::string("has no section '") + name + "'; bake the scene again");
        if (section->decoded > most) throw Error(path.string(), quoted(*section) + " is too large; bake the scene again");
        raw = decode(file, *section, path);
        return Reader(raw, path, quoted(*section));
    };
    Baked baked;
    decode_settings(open("SETT"), baked);
    decode_plan(open("PLAN"), baked);
    if (find(sections, "LMAP")) {
        DayLightmap& map = baked.lightmap.emplace();
        const std::size_t corners = decode_lightmap(open("LMAP"), map);
        decode_corner_uvs(open("LMUV", corners * sizeof(Vec2)), corners, map);
        decode_texels(open("LMTX", texel_halves(map) * sizeof(std::uint16_t)), map);
    }
    if (find(sections, "VOLU")) {
        IrradianceVolume& volume = baked.volume.emplace();
        decode_volume(open("VOLU"), volume);
        Reader r = open("VOSH", probe_halves(volume) * sizeof(std::uint16_t));
        volume.components = finite_halves(r, probe_halves(volume), "probe");
    }
    return baked;
}

void write_baked(const Path& path, const Baked& baked) {
    std::vector<Payload> lightmap, volume;
    if (const auto& map = baked.lightmap) {
        lightmap.push_back(compress("LMAP", code_lightmap(*map)));
        lightmap.push_back(compress("LMUV", raw_bytes(map->corner_uvs)));
        lightmap.push_back(compress("LMTX", raw_bytes(map->components)));
    }
    if (baked.volume) {
        volume.push_back(compress("VOLU", code_volume(*baked.volume)));
        volume.push_back(compress("VOSH", raw_bytes(baked.volume->components)));
    }
    std::vector<Payload> payloads = {compress("SETT", code_settings(baked)),
                                     compress("PLAN", code_plan(with_bytes(baked.plan, lightmap, volume)))};
    for (std::vector<Payload>* part : {&lightmap, &volume})
        std::move(part->begin(), part->end(), std::back_inserter(payloads));
    write_file(path, assemble(std::move(payloads)));
}

void require_same_geometry(const Baked& baked, const Path& baked_path, const WorldMesh& static_mesh,
                           const Path& scene_path) {
    const bool same = baked.geometry_hash == geometry_hash(static_mesh);
    const bool same_corners = !baked.lightmap || baked.lightmap->corner_uvs.size() == 3 * static_mesh.triangle_count();
    if (!same || !same_corners)
        throw Error(baked_path.string(), "was baked for other static geometry than that of " + scene_path.string() +
                                             "; bake that scene again");
}

}  // namespace daylit
