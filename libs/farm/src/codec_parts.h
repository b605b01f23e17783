#pragma once
/// Parts that several kinds of jobs and results have, as messages hold them.

#include <ssphh/farm/job.h>
#include <ssphh/probes/probe_codec.h>

#include "message.h"

namespace ssphh::farm {

json::Value put(const SceneRef& scene);
SceneRef get_scene(const Field& f);

/// x, y, z and radius of each; null: none.
json::Value put(std::span<const ProbeSphere> places, MessageWriter& out);
std::vector<ProbeSphere> get_places(const Field& f, std::size_t most);

/// The alphabet of messages for probe_codec.h: members of an object, floats where the message has them.
struct MessageParts {
  json::Value& object;
  MessageWriter& out;

  void index(const char* name, int value) { object[name] = value; }
  void amount(const char* name, float value) { object[name] = exact(value); }
  void vectors(const char* name, std::span<const vec3> values, probes::Missing missing) {
    if (!values.empty() || missing != probes::Missing::absent) object[name] = out.vectors(values);
  }
};
using FieldParts = probes::JsonParts<Field>;

json::Value put(const std::vector<probes::GroupLight>& light, MessageWriter& out);
json::Value put(const std::vector<probes::Edge>& edges, MessageWriter& out);
std::vector<probes::GroupLight> get_light(const Field& f, int degree);

// --- transport (transport_codec.cpp)

json::Value put(const TransportJob& job, MessageWriter& out);
TransportJob get_transport_job(const Field& f);
json::Value put(const TransportJobResult& result, MessageWriter& out);
TransportJobResult get_transport_result(const Field& f);

}  // namespace ssphh::farm
