"""The goal-directed tasks of the CARLA paper as Gymnasium environments.

    import gymnasium, reprise.gym
    env = gymnasium.make('reprise/Navigation-v0', town='town1', task='one_turn', obs='state')

or, without the import, gymnasium.make('reprise.gym:reprise/Navigation-v0').

Dosovitskiy et al., "CARLA: An Open Urban Driving Simulator", CoRL 2017: tasks, reward, success and infractions are its
(reprise.navigation). Needs gymnasium. Each environment has a process of its own that simulates; several at once are

    envs = gymnasium.make_vec('reprise/Navigation-v0', num_envs=4, town='town1', task='one_turn')
"""
from __future__ import annotations

import os
from typing import Any

import gymnasium
import numpy as np

from .arguments import whole
from .driver import Control
from .navigation import TASKS, Journey, action_space, cars_of, control_of, observation_space, read_episodes, rig_of
from .simulation import Simulation
from .wire import POLLING

__all__ = ["TASKS", "Navigation", "NavigationVector"]


class Navigation(gymnasium.Env):
    """From a place to a goal, told only the next turning.

    Action, float32 (2,): steer in [-1, 1], left positive; pedals in [-1, 1], throttle above 0, brake below.

    Observation 'state', float32 (22,): speed [m/s], way to the goal [km], the command one-hot (COMMANDS), place left of
    the lane's centre [m], sine and cosine of the angle to the lane, gap ahead [m], shares of the footprint on the
    opposite lane and on the sidewalk, damage (impulse) [1000 N s], steering angle [rad], and of the NEAR nearest
    vehicles where they are ahead and left [m], FAR where there is none.

    Observation 'rgb84', uint8 (84, 84, 3), and 'rgb200x88', uint8 (88, 200, 3): a camera behind the windscreen, 90 degrees.

    An episode is one of 25 of its kind, chosen by the seed, or options={'episode': 3}. It terminates on arrival; the
    time of the way at 10 km/h truncates it. `info`: 'success' at the end, 'infractions' so far, 'command',
    'way_to_goal' [m], 'reward_terms'.

    `weather` is a preset's name, or a list to draw from. `cars` take the place of the task's own number. `server` and
    `token` as of reprise.Simulation, `polling` too, `every` (an action holds for so many ticks of 0.05 s), and `folder`, where options={'trace': 'a.mcap'} records an episode; `tasks` is the
    path of another tasks.json.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 20}

    def __init__(self, town: str = "town1", task: str = "navigation", weather: str | list[str] = "clear_noon",
                 obs: str = "state", cars: int | None = None, server: str | None = None, token: str | None = None,
                 tasks: str | os.PathLike | None = None, folder: str | os.PathLike = ".",
                 render_mode: str | None = None, polling: float = POLLING, every: int = 1) -> None:  # fmt: skip
        self.render_mode = render_mode
        self.episodes = read_episodes(town, task, tasks)
        self.weathers = [weather] if isinstance(weather, str) else list(weather)
        if not self.weathers:
            raise ValueError("weather=[]: expected the name of a preset, or several to draw from")
        self.action_space = action_space()
        self.observation_space = observation_space(obs)
        self._obs = obs
        self._sim = Simulation(town, cars=cars_of(town, task, cars), server=server, token=token, rig=rig_of(obs),
                               folder=folder, polling=polling, every=every)  # fmt: skip
        self.metadata = {**self.metadata, "render_fps": 20 / every}
        self._journey: Journey | None = None

    def reset(self, *, seed: int | None = None,
              options: dict[str, Any] | None = None) -> tuple[np.ndarray, dict[str, Any]]:  # fmt: skip
        super().reset(seed=seed)
        chosen = int(self.np_random.integers(len(self.episodes)))
        traffic = int(self.np_random.integers(2**31))
        weather = self.weathers[int(self.np_random.integers(len(self.weathers)))]
        options = options or {}
        chosen = whole("options: episode", options.get("episode", chosen), 0, len(self.episodes) - 1, "of this task")
        task = self.episodes[chosen]
        start, goal = ((task[end]["lane"], task[end]["s"]) for end in ("start", "goal"))
        self._sim.reset(seed=traffic, weather=weather, start=start, goal=goal, trace=options.get("trace"))
        seen = self._sim.step()  # the goal is known from the tick after the vehicle appeared
        if seen is None:
            raise RuntimeError("the episode ended before it began")
        self._journey = Journey(self._obs, seen)
        return self._journey.observation, {"episode": chosen, **self._journey.info()}

    def step(self, action: np.ndarray) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        self.begin_step(action)
        return self.end_step()

    def begin_step(self, action: np.ndarray) -> None:
        """The first half of step(): from here on the tick is simulated, whatever is done meanwhile."""
        self._say(control_of(action))

    def _say(self, control: Control) -> None:
        if self._journey is None:
            raise gymnasium.error.ResetNeeded("step() before reset()")
        self._sim.say(control)

    def end_step(self) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """The other half: waits for the tick, and returns what step() returns."""
        if self._journey is None:
            raise gymnasium.error.ResetNeeded("end_step() before begin_step()")
        journey, seen = self._journey, self._sim.hear()
        success = seen is None and self._sim.outcome is not None and self._sim.outcome.verdict == "passed"
        terms = journey.look(seen) if seen is not None else journey.arrive() if success else journey.stay()
        info = {**journey.info(), "reward_terms": terms}
        if seen is None:
            info["success"] = success
        return journey.observation, float(sum(terms.values())), success, seen is None and not success, info

    def render(self) -> np.ndarray | None:
        """What the camera of 'rgb84' or 'rgb200x88' sees, uint8 (height, width, 3), with render_mode='rgb_array'."""
        if self.render_mode != "rgb_array" or self._journey is None:
            return None
        if self._journey.observation.ndim != 3:
            raise gymnasium.error.Error("render: obs='state' has no camera: make it with obs='rgb84', or look at a trace")
        return self._journey.observation

    def close(self) -> None:
        self._sim.close()


class NavigationVector(gymnasium.vector.VectorEnv):
    """Several of Navigation, from one program: all are told what to do before the first is waited for, so that as many
    ticks are simulated at once as there are processors. No Python beside each, as with vectorization_mode='async', whose
    pipes take longer than a tick. Arguments are Navigation's; equal seeds and actions give what gymnasium's own vectors
    give. Whoever has ended is reset by the next step, and its action is passed over.
    """

    metadata: dict[str, Any] = {**Navigation.metadata}
    if hasattr(gymnasium.vector, "AutoresetMode"):  # from 1.1 on; 1.0 has no other mode
        metadata["autoreset_mode"] = gymnasium.vector.AutoresetMode.NEXT_STEP

    def __init__(self, num_envs: int = 1, polling: float = 0.0, **arguments: Any) -> None:
        if num_envs < 1:
            raise ValueError(f"num_envs: at least 1, got {num_envs}")
        self.num_envs = num_envs
        self.render_mode = arguments.get("render_mode")
        self.envs: list[Navigation] = []
        try:
            for _ in range(num_envs):
                self.envs.append(Navigation(polling=polling, **arguments))
        except BaseException:
            self.close_extras()
            raise
        self.single_action_space = self.envs[0].action_space
        self.single_observation_space = self.envs[0].observation_space
        self.action_space = gymnasium.vector.utils.batch_space(self.single_action_space, num_envs)
        self.observation_space = gymnasium.vector.utils.batch_space(self.single_observation_space, num_envs)
        self._ended = [False] * num_envs

    def reset(self, *, seed: int | list[int | None] | None = None,
              options: dict[str, Any] | None = None) -> tuple[np.ndarray, dict[str, Any]]:  # fmt: skip
        seeds = [None if seed is None else seed + i for i in range(self.num_envs)] if not isinstance(seed, list) else seed
        if len(seeds) != self.num_envs:
            raise ValueError(f"reset: {len(seeds)} seeds for {self.num_envs} environments")
        seen, infos = [], {}
        for i, env in enumerate(self.envs):
            one, info = env.reset(seed=seeds[i], options=options)
            seen.append(one)
            infos = self._add_info(infos, info, i)
        self._ended = [False] * self.num_envs
        return np.stack(seen), infos

    def step(self, actions: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]:
        # All of them before one is said: where one cannot be, no environment is a step ahead of the others.
        controls = [None if ended else control_of(action) for ended, action in zip(self._ended, actions, strict=True)]
        for env, control in zip(self.envs, controls):
            if control is not None:
                env._say(control)
        results, infos = [], {}
        for i, env in enumerate(self.envs):
            if self._ended[i]:
                seen, info = env.reset()
                results.append((seen, 0.0, False, False))
            else:
                *result, info = env.end_step()
                results.append(tuple(result))
            infos = self._add_info(infos, info, i)
        seen, rewards, terminated, truncated = (np.array(all_of_one) for all_of_one in zip(*results))
        self._ended = list(terminated | truncated)
        return seen, rewards.astype(np.float64), terminated, truncated, infos

    def render(self) -> tuple[np.ndarray | None, ...]:
        return tuple(env.render() for env in self.envs)

    def close_extras(self, **_: Any) -> None:
        for env in self.envs:
            env.close()


if "reprise/Navigation-v0" not in gymnasium.registry:
    gymnasium.register("reprise/Navigation-v0", entry_point="reprise.gym:Navigation",
                       vector_entry_point="reprise.gym:NavigationVector")  # fmt: skip
