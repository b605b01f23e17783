#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include <ssphh/core/json.h>
#include <ssphh/probes/probe_codec.h>
#include <ssphh/probes/probe_file.h>

#include "json_number.h"

namespace ssphh::probes {
namespace {

class Writer {
 public:
  explicit Writer(const ProbeSet& set) : set_(set) {}

  std::string run() {
    const GeneratorInfo& g = set_.generator;
    put("{{\"format\":\"ssphh-probes\",\"version\":{},\n\"degree\":{},\n", probe_file_version, set_.degree);
    put("\"generator\":{{\"operator\":\"{}\",\"gen\":\"{}\",\"max_depth\":{},\"passes\":{},\"spp\":{},\n",
        name_of(g.op), name_of(g.gen), g.max_depth, g.passes, g.spp);
    put("\"viz\":\"{}\",\"viz_source\":\"{}\",\"viz_paths\":\"{}\",\"viz_max_depth\":{},\"viz_passes\":{},"
        "\"viz_spp\":{},\n",
        name_of(g.viz), name_of(g.viz_source), name_of(g.viz_paths), g.viz_max_depth, g.viz_passes,
        g.viz_spp);
    put("\"face_size\":{},\"seed\":\"{:x}\",\n", g.face_size, g.seed);
    put("\"directions\":{},\"surfel_size\":{},\"link_rays\":{},\n", g.directions, exact(g.surfel_size),
        g.link_rays);
    put("\"scene\":{},\"scene_hash\":\"{}\",\"time\":{}}},\n", quoted(g.scene), g.scene_hash.hex(),
        exact(g.time));
    put("\"light_groups\":[");
    for (std::size_t i = 0; i < set_.light_groups.size(); ++i) {
      const LightGroup& group = set_.light_groups[i];
      put("{}\n{{\"name\":{},\"scale\":{},\"mode\":\"{}\"}}", comma(i), quoted(group.name),
          exact(group.scale), name_of(group.mode));
    }
    put("],\n\"probes\":[");
    for (std::size_t i = 0; i < set_.probes.size(); ++i) probe(i);
    put("]");
    if (set_.hierarchy) {
      const Hierarchy& h = *set_.hierarchy;
      put(",\n\"hierarchy\":{{\"operator\":\"{}\",\"neighbors\":{},\"threshold\":{}}}", name_of(h.op),
          h.neighbors, exact(h.threshold));
    }
    if (set_.fitted) fitted(*set_.fitted);
    if (set_.surface) surface(*set_.surface);
    if (set_.baseline) baseline(*set_.baseline);
    put("}}\n");
    return std::move(out_);
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }
  static const char* comma(std::size_t i) { return i == 0 ? "" : ","; }
  static std::string quoted(const std::string& text) { return json::print(text); }
  static std::string exact(float value) { return fmt::format("{}", value + 0.0f); }  // + 0: no negative zero
  static std::string exact(const vec3& v) {
    return fmt::format("[{},{},{}]", exact(v.x), exact(v.y), exact(v.z));
  }

  void numbers(std::span<const vec3> values) {
    out_ += '[';
    for (std::size_t k = 0; k < values.size(); ++k) {
      for (int c = 0; c < 3; ++c) {
        if (k + static_cast<std::size_t>(c) > 0) out_ += ',';
        append_five_digits(out_, values[k][c]);
      }
    }
    out_ += ']';
  }

  /// The alphabet of this text for probe_codec.h: members between braces, functions on lines of their own.
  struct Parts {
    Writer& writer;
    bool first = true;

    void index(const char* name, int value) { begin(name), writer.put("{}", value); }
    void amount(const char* name, float value) { begin(name), append_five_digits(writer.out_, value); }
    void vectors(const char* name, std::span<const vec3> values, Missing missing) {
      if (values.empty() && missing == Missing::absent) return;
      begin(name, "\n"), writer.numbers(values);
    }
    void begin(const char* name, const char* line = "") {
      if (!std::exchange(first, false)) writer.put(",{}", line);
      writer.put("\"{}\":", name);
    }
  };

  void fitted(const FittedPoints& f) {
    put(",\n\"fitted\":[");
    for (std::size_t i = 0; i < f.points.size(); ++i) {
      put("{}\n{{\"position\":{},\"normal\":{},\"probes\":[", comma(i), exact(f.points[i].position),
          exact(f.points[i].normal));
      const auto weights = f.weights[i].used();
      for (std::size_t k = 0; k < weights.size(); ++k) put("{}{}", comma(k), weights[k].probe);
      put("],\"weights\":[");
      for (std::size_t k = 0; k < weights.size(); ++k) {
        put("{}", comma(k));
        append_five_digits(out_, weights[k].weight);
      }
      put("]}}");
    }
    put("]");
  }

  void surface(const SurfaceRecords& s) {
    put(",\n\"surface\":[");
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      put("{}\n{{\"position\":{},\"normal\":{},\"groups\":[", comma(i), exact(s.points[i].position),
          exact(s.points[i].normal));
      const auto light = [&](const PackedRecordLight& l) {
        put("[{}", exact(l.scale));
        for (const std::int16_t v : l.values) put(",{}", v);
        put("]");
      };
      for (std::size_t g = 0; g < s.groups.size(); ++g) {
        put("{}", comma(g));
        light(s.groups[g][i]);
      }
      put("]");
      if (!s.direct.empty()) put(",\"direct\":[");
      for (std::size_t g = 0; g < s.direct.size(); ++g) {
        put("{}", comma(g));
        s.keeps_direct(g) ? light(s.direct[g][i]) : put("[]");
      }
      if (!s.direct.empty()) put("]");
      put("}}");
    }
    put("]");
  }

  /// With all digits: an update tells from the last one whether anything has changed.
  void baseline(const Baseline& b) {
    put(",\n\"baseline\":{{\"neighbors\":{},\"threshold\":{},\"records\":{},\"surfels\":{},\n\"items\":[",
        b.viz_neighbors, exact(b.viz_threshold), b.records, b.most_surfels);
    for (std::size_t i = 0; i < b.items.size(); ++i) {
      const scene::SceneItem& item = b.items[i];
      put("{}\n{{\"kind\":\"{}\",\"name\":{},\"shape\":\"{}\",\"place\":\"{}\",\"surface\":\"{}\","
          "\"emission\":\"{}\"}}",
          comma(i), name_of(item.kind), quoted(item.name), item.shape.hex(), item.place.hex(),
          item.surface.hex(), item.emission.hex());
    }
    put("],\n\"trials\":[");
    for (std::size_t i = 0; i < b.trials.size(); ++i) {
      put("{}\n[", comma(i));
      for (std::size_t half = 0; half < 2; ++half) {
        put("{}[", comma(half));
        const std::vector<sh::RadianceSh>& groups = b.trials[i].halves[half];
        for (std::size_t g = 0; g < groups.size(); ++g) {
          put("{}[", comma(g));
          for (std::size_t k = 0; k < groups[g].values.size(); ++k) {
            const vec3& v = groups[g].values[k];
            put("{}{},{},{}", comma(k), exact(v.x), exact(v.y), exact(v.z));
          }
          put("]");
        }
        put("]");
      }
      put("]");
    }
    put("]}}");
  }

  void probe(std::size_t i) {
    const Probe& p = set_.probes[i];
    put("{}\n{{\"name\":{},\"position\":{},\"radius\":{},\n\"groups\":[", comma(i), quoted(p.name),
        exact(p.position), exact(p.radius));
    for (std::size_t g = 0; g < p.groups.size(); ++g) {
      put("{}\n{{", comma(g));
      write_light(Parts{*this}, p.groups[g]);
      put("}}");
    }
    put("],\n\"edges\":[");
    for (std::size_t e = 0; e < p.edges.size(); ++e) {
      put("{}\n{{", comma(e));
      write_edge(Parts{*this}, p.edges[e]);
      put("}}");
    }
    put("]");
    if (set_.hierarchy) {
      put(",\n\"neighbor\":");
      numbers(set_.hierarchy->neighbor[i].values);
    }
    put("}}");
  }

  const ProbeSet& set_;
  std::string out_;
};

}  // namespace

void append_five_digits(std::string& out, float value) {
  // Smaller values lose digits as denormal floats and would not survive a second round trip.
  if (!(std::abs(value) >= 1e-35f)) {
    out += '0';
    return;
  }
  // Decimal mantissa "d.dddd" and exponent, then the shorter of fixed and scientific notation.
  char text[32];
  *fmt::format_to_n(text, sizeof(text) - 1, "{:.4e}", std::abs(value)).out = '\0';
  std::string digits{text[0]};
  digits.append(text + 2, 4);
  const int exponent = std::atoi(text + 7);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (value < 0) out += '-';
  const int count = static_cast<int>(digits.size());
  if (exponent >= 0 && exponent <= 6) {
    // 12345, 1.2345, 1234500
    if (count <= exponent + 1) {
      out += digits + std::string(static_cast<std::size_t>(exponent + 1 - count), '0');
    } else {
      digits.insert(static_cast<std::size_t>(exponent + 1), 1, '.');
      out += digits;
    }
  } else if (exponent < 0 && exponent >= -2) {
    // 0.012345
    out += "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  } else {
    // 1.2345e-3
    if (count > 1) digits.insert(1, 1, '.');
    fmt::format_to(std::back_inserter(out), "{}e{}", digits, exponent);
  }
}

std::string probes_to_json(const ProbeSet& set) {
  validate(set, "probe set");
  return Writer(set).run();
}

}  // namespace ssphh::probes
