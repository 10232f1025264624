"""The goal-directed tasks of the CARLA paper for several learners in one town: a PettingZoo parallel environment.

    from reprise import zoo
    env = zoo.navigation(agents=3, town='town1', cars=20)
    observations, infos = env.reset(seed=7)
    while env.agents:
        actions = {agent: env.action_space(agent).sample() for agent in env.agents}
        observations, rewards, terminations, truncations, infos = env.step(actions)

Needs pettingzoo. What one agent sees, does and is rewarded for is that of reprise.gym; others are seen among the cars.
"""
from __future__ import annotations

import itertools
import os
from typing import Any, Mapping

import numpy as np
from gymnasium import spaces
from gymnasium.utils import seeding
from pettingzoo import ParallelEnv

from . import navigation as nav
from .driver import Control, Observation
from .multi_simulation import MultiSimulation
from .nouns import enum

_PRINTED = enum("EventKind")["printed"]
_ARRIVED, _LATE = " has arrived", " is out of time"  # what the scenario prints behind an agent's name
_SCENARIO = """-- Drivers in another program, each from a place to a goal within the time that its way takes at 10 km/h
-- (Dosovitskiy et al., CoRL 2017). Who has arrived, or is out of time, is taken off the road.
return scenario 'journeys' {{
    town = '{town}', cars = {cars}, weather = '{weather}', duration = 7200,
    run = function()
        local on_the_road = 0
        local function travel(name, from, to)
            local ego = spawn{{ name = name, model = 'sedan', driver = 'external', lane = from.lane, s = from.s, every = {every}{rig} }}
            on_the_road = on_the_road + 1
            start(function()
                local length = ego:route_to{{ lane = to.lane, s = to.s }}
                local limit = length / (10 / 3.6)
                -- The goal may lie on the lane that we start from, behind us.
                local function arrived()
                    return ego:distance_driven() > length - 10 and ego:lane() == to.lane and ego:s() >= to.s
                end
                check.eventually(name .. ' arrives in time', arrived, {{ within = limit }})
                print(name .. (wait_until(arrived, {{ timeout = limit }}) and '{arrived}' or '{late}'))
                wait_ticks({every})  -- its driver is shown that before it is taken away
                ego:despawn()
                on_the_road = on_the_road - 1
            end)
        end
{journeys}
        wait_until(function() return on_the_road == 0 end)
        finish 'all are where they wanted to be, or out of time'
    end,
}}
"""


def navigation(agents: int = 2, **arguments: Any) -> ParallelNavigation:
    """The environment; arguments as of ParallelNavigation."""
    return ParallelNavigation(agents, **arguments)


class ParallelNavigation(ParallelEnv):
    """Several vehicles 'car_0', 'car_1', ... in one town, each with an episode of its own of the task.

    Actions, observations, rewards and infos as of reprise.gym.Navigation. An agent terminates on arrival and is
    truncated when the time of its way at 10 km/h is over; `info['success']` says which. It leaves `agents` then and its
    car leaves the road. The seed chooses the episodes, of different start lanes, and the traffic;
    options={'episodes': [3, 8], 'trace': 'a.mcap'} names them. An action holds for `every` ticks. `cars` are those that nobody learns to drive.
    """

    metadata: dict[str, Any] = {"name": "reprise/navigation_v0", "render_modes": [], "is_parallelizable": True}

    def __init__(self, agents: int = 2, town: str = "town1", task: str = "navigation", weather: str = "clear_noon",
                 obs: str = "state", cars: int | None = None, server: str | None = None, token: str | None = None,
                 tasks: str | os.PathLike | None = None, folder: str | os.PathLike = ".",
                 render_mode: str | None = None, every: int = 1) -> None:  # fmt: skip
        self.render_mode = render_mode
        self.episodes = nav.read_episodes(town, task, tasks)
        most = len({episode["start"]["lane"] for episode in self.episodes})
        if not 1 <= agents <= most:
            raise ValueError(f"agents={agents}: expected 1 to {most}: so many lanes do episodes of this task start from")
        self.possible_agents = [f"car_{number}" for number in range(agents)]
        self.agents: list[str] = []
        self._action_spaces = {agent: nav.action_space() for agent in self.possible_agents}
        self._observation_spaces = {agent: nav.observation_space(obs) for agent in self.possible_agents}
        self._obs, self._rig = obs, nav.rig_of(obs)
        self._told = dict(town=town, cars=nav.cars_of(town, task, cars), weather=weather,
                          every=every, arrived=_ARRIVED, late=_LATE)  # fmt: skip
        self._journeys: dict[str, nav.Journey] = {}
        self._seen: dict[str, Observation] = {}
        self._random, _ = seeding.np_random()
        self._sim = MultiSimulation(self.possible_agents, self._scenario(range(agents)), server=server, token=token,
                                    folder=folder)  # fmt: skip

    def observation_space(self, agent: str) -> spaces.Box:
        return self._observation_spaces[agent]

    def action_space(self, agent: str) -> spaces.Box:
        return self._action_spaces[agent]

    def _scenario(self, chosen: Any) -> str:
        """Lua, with an episode for each agent."""
        def place(of: Mapping[str, Any]) -> str:
            return f"{{ lane = '{of['lane']}', s = {float(of['s'])!r} }}"

        journeys = [f"        travel('{agent}', {place(self.episodes[number]['start'])}, {place(self.episodes[number]['goal'])})"
                    for agent, number in zip(self.possible_agents, chosen)]  # fmt: skip
        cameras = [f"{{ name = '{one['name']}', width = {one['width']}, height = {one['height']} }}" for one in self._rig]
        rig = f", rig = {{ {', '.join(cameras)} }}" if cameras else ""
        return _SCENARIO.format(**self._told, rig=rig, journeys="\n".join(journeys))

    def _choose(self) -> list[int]:
        """An episode for each agent, no two from one lane."""
        chosen: dict[str, int] = {}
        for number in self._random.permutation(len(self.episodes)).tolist():
            chosen.setdefault(self.episodes[number]["start"]["lane"], number)
        return list(chosen.values())[: len(self.possible_agents)]

    def reset(self, seed: int | None = None,
              options: dict[str, Any] | None = None) -> tuple[dict[str, np.ndarray], dict[str, dict]]:  # fmt: skip
        if seed is not None:
            self._random, _ = seeding.np_random(seed)
        chosen, traffic = self._choose(), int(self._random.integers(2**31))
        options = options or {}
        chosen = list(options.get("episodes", chosen))
        if len(chosen) != len(self.possible_agents):
            raise ValueError(f"options: 'episodes' names {len(chosen)} for {len(self.possible_agents)} agents")
        for number in chosen:
            if not 0 <= number < len(self.episodes):
                raise ValueError(f"options: 'episodes' names {number}, of {len(self.episodes)}: expected 0 to {len(self.episodes) - 1}")
        seen = self._sim.reset(scenario=self._scenario(chosen), seed=traffic, trace=options.get("trace"))
        # The goals are known from the tick after the vehicles appeared.
        self._seen = self._sim.step({agent: Control() for agent in seen})
        self.agents = list(self.possible_agents)
        self._journeys = {agent: nav.Journey(self._obs, self._seen[agent]) for agent in self.agents}
        return ({agent: journey.observation for agent, journey in self._journeys.items()},
                {agent: {"episode": number, **self._journeys[agent].info()}
                 for agent, number in zip(self.agents, chosen)})  # fmt: skip

    def _ended(self, agent: str) -> bool | None:
        """Whether it has arrived, once that is decided."""
        seen = self._seen[agent]
        for event in itertools.chain.from_iterable(tick.events for tick in (*seen.passed, seen.tick)):
            if event.kind == _PRINTED and event.text in (agent + _ARRIVED, agent + _LATE):
                return event.text == agent + _ARRIVED
        return None

    def step(self, actions: Mapping[str, Any]) -> tuple[
            dict[str, np.ndarray], dict[str, float], dict[str, bool], dict[str, bool], dict[str, dict]]:  # fmt: skip
        # Whose episode is over stands until it is taken away.
        controls = {agent: nav.control_of(actions[agent]) if agent in self.agents else Control(brake=1.0) for agent in self._seen}
        self._seen = self._sim.step(controls) if controls else {}
        observations, rewards, terminations, truncations, infos = {}, {}, {}, {}, {}  # type: ignore[var-annotated]
        for agent in self.agents:
            journey, there = self._journeys[agent], agent in self._seen
            arrived = self._ended(agent) if there else False
            terms = journey.look(self._seen[agent]) if there else journey.stay()
            if arrived:
                terms["way"] += journey.arrive()["way"]
            infos[agent] = {**journey.info(), "reward_terms": terms}
            if arrived is not None:
                infos[agent]["success"] = arrived
            observations[agent], rewards[agent] = journey.observation, float(sum(terms.values()))
            terminations[agent], truncations[agent] = arrived is True, arrived is False
        self.agents = [agent for agent in self.agents if not (terminations[agent] or truncations[agent])]
        while self._seen and not self.agents:  # the last one is taken away, and the run comes to its own end
            self._seen = self._sim.step({agent: Control(brake=1.0) for agent in self._seen})
        return observations, rewards, terminations, truncations, infos

    def render(self) -> None:
        """Nothing: render the trace of an episode, or look at it by reprise.Trace(...).show()."""

    def close(self) -> None:
        self._sim.close()
