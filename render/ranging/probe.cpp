#include "render/ranging/probe.h"

#include "render/look/look.h"
#include "render/ranging/reflectance.h"
#include "render/scene/twist.h"
#include "world/check.h"

namespace reprise::render {

std::vector<ProbeEcho> probe_scene(const Scene& scene,
                                   const world::TickView& tick,
                                   std::span<const Probe> probes,
                                   double range,
                                   std::uint32_t mask) {
    std::vector<Beam> beams;
    for (const Probe& probe : probes) {
        const double length = probe.direction.norm();
        if (!(length > 0) || !probe.origin.allFinite() || !probe.direction.allFinite())
            throw world::Error("a probe's origin or direction is not possible");
        beams.push_back({probe.origin - scene.origin(), probe.direction / length});
    }
    std::vector<Echo> echoes(beams.size());
    find_echoes(scene, beams, range, mask, echoes);
    std::vector<ProbeEcho> answers(beams.size());
    for (std::size_t i = 0; i < beams.size(); ++i) {
        const Echo& echo = echoes[i];
        if (!echo)
            continue;
        ProbeEcho& answer = answers[i];
        answer.distance = echo.distance;
        answer.actor = echo.instance->actor;
        answer.label = semantic_class(scene, echo.hit);
        answer.normal = normal_of(echo, beams[i]);
        answer.reflectivity = reflectance_of(scene, echo).diffuse;
        answer.cross_section = radar_share(scene, echo);
        if (const auto twist = find_twist(tick, answer.actor); answer.actor != 0 && twist)
            answer.velocity = twist->velocity_at(beams[i].origin + scene.origin() +
                                                 echo.distance * beams[i].direction);
    }
    return answers;
}

}  // namespace reprise::render
