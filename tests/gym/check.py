#!/usr/bin/env python3
"""Holds the environments of reprise.gym and reprise.zoo against the checkers of Gymnasium and PettingZoo, and against
what they promise: check.py

With Stable-Baselines3 installed also against its checker, and 2,000 steps of PPO. Called by `./dev gym`.
"""
import contextlib
import io
import json
import pathlib
import subprocess
import tempfile
import time
import warnings

import gymnasium
import numpy as np
from gymnasium.utils.env_checker import check_env
from pettingzoo.test import parallel_api_test, parallel_seed_test

import reprise
import reprise.gym
import reprise.zoo
from reprise.simulation import find_program

NAME = "reprise/Navigation-v0"


def episode(env, seed, steps):
    seen, info = env.reset(seed=seed)
    all_seen, rewards = [seen], []
    actions = np.random.default_rng(3)
    for _ in range(steps):
        action = np.array([actions.uniform(-0.1, 0.1), 0.6], np.float32)
        seen, reward, terminated, truncated, info = env.step(action)
        all_seen.append(seen)
        rewards.append(reward)
        if terminated or truncated:
            break
    return np.array(all_seen), np.array(rewards), info


def gymnasiums_checker():
    for task in reprise.gym.TASKS:
        env = gymnasium.make(NAME, town="town1", task=task)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # unbounded observations are meant so
            check_env(env.unwrapped, skip_render_check=True)
        env.close()


def same_seed_and_actions_give_equal_observations():
    env = gymnasium.make(NAME, task="navigation_dynamic", weather=["clear_noon", "hard_rain_sunset"])
    first = episode(env, 11, 100)
    other = episode(env, 12, 100)
    again = episode(env, 11, 100)
    env.close()
    assert np.array_equal(first[0], again[0]) and np.array_equal(first[1], again[1])
    assert not np.array_equal(first[0], other[0])


def the_reward_is_the_way_that_was_gained():
    env = gymnasium.make(NAME, task="straight")
    _, info = env.reset(seed=1, options={"episode": 0})
    begin, rewards = info["way_to_goal"], []
    for _ in range(60):
        _, reward, _, _, info = env.step(np.array([0, 0.5], np.float32))
        rewards.append(info["reward_terms"]["way"])
    env.close()
    assert np.isclose(sum(rewards), begin - info["way_to_goal"]) and sum(rewards) > 5, (sum(rewards), begin, info)


def standing_still_is_truncated_when_the_time_is_over():
    env = gymnasium.make(NAME, task="straight")
    _, info = env.reset(seed=1, options={"episode": 4})
    limit = info["way_to_goal"] / (10 / 3.6) / 0.05
    for steps in range(10_000):
        _, _, terminated, truncated, info = env.step(np.array([0, -1], np.float32))
        if terminated or truncated:
            break
    env.close()
    assert truncated and not terminated and info["success"] is False
    assert abs(steps - limit) < 5, (steps, limit)


def an_action_holds_for_as_many_ticks_as_was_said():
    """`every=4` is what one tick after the other is, with each action said four times."""
    one, four = (gymnasium.make(NAME, task="navigation_dynamic", every=every) for every in (1, 4))
    assert four.unwrapped.metadata["render_fps"] == 5
    one.reset(seed=2)
    seen_four, _ = four.reset(seed=2)
    nothing = np.zeros(2, np.float32)
    for _ in range(3):  # the goal is known from the second tick that is shown, here the fifth
        seen, *_ = one.step(nothing)
    assert np.array_equal(seen, seen_four)
    actions = np.random.default_rng(3)
    for _ in range(40):
        action = np.array([actions.uniform(-0.2, 0.2), 0.7], np.float32)
        rewards = []
        for _ in range(4):
            seen, reward, _, _, info = one.step(action)
            rewards.append(reward)
        seen_four, reward, _, _, info_four = four.step(action)
        assert np.array_equal(seen, seen_four) and np.isclose(sum(rewards), reward)
        assert info["infractions"] == info_four["infractions"]
    one.close()
    four.close()
    assert sum(info["infractions"].values()) > 0, "it did nothing wrong: this shows nothing of infractions"


def two_at_once():
    envs = gymnasium.make_vec(NAME, num_envs=2, vectorization_mode="async", task="one_turn")
    seen, _ = envs.reset(seed=5)
    for _ in range(20):
        seen, *_ = envs.step(np.tile(np.array([0, 0.5], np.float32), (2, 1)))
    envs.close()
    assert seen.shape == (2, 22) and not np.array_equal(seen[0], seen[1])


def a_vector_is_what_gymnasiums_own_is():
    """Equal seeds and actions, with a goal 12 m ahead: one arrives, is reset and goes on; the other brakes."""
    begin = reprise.gym.Navigation(task="straight")
    tasks = {"straight": [dict(task, goal=dict(lane=task["start"]["lane"], s=task["start"]["s"] + 12))
                          for task in begin.episodes[:2]]}  # fmt: skip
    begin.close()
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "tasks.json"
        file.write_text(json.dumps({"tasks": tasks}))
        all_seen = []
        for mode in (None, "sync"):
            envs = gymnasium.make_vec(NAME, num_envs=2, vectorization_mode=mode, task="straight", tasks=file, cars=10)
            seen, infos = envs.reset(seed=5)
            story = [(seen, infos["way_to_goal"])]
            for _ in range(200):
                seen, rewards, terminated, truncated, infos = envs.step(np.array([[0, 0.6], [0, -1]], np.float32))
                story.append((seen, rewards, terminated, truncated, infos["way_to_goal"]))
            envs.close()
            all_seen.append(story)
    for ours, theirs in zip(*all_seen, strict=True):
        assert all(np.array_equal(one, other) for one, other in zip(ours, theirs, strict=True)), (ours, theirs)
    ended = np.array([step[2] for step in all_seen[0][1:]])
    assert ended[:, 0].sum() >= 1 and not ended[:, 1].any(), ended.sum(axis=0)


def what_cannot_be_is_told():
    def refuses(what, *words):
        try:
            what()
        except ValueError as error:
            assert all(word in str(error) for word in words), error
        else:
            raise AssertionError(words)

    refuses(lambda: reprise.gym.Navigation(every=0), "every=0")
    refuses(lambda: reprise.gym.Navigation(weather=[]), "weather=[]")
    refuses(lambda: reprise.gym.Navigation(town="nowhere"), "of the town 'nowhere', but of town1, town2; ", "tasks=")
    env = reprise.gym.Navigation(task="straight")
    for wrong in (np.zeros(3, np.float32), [0.5], 0.5, None, "ab", np.zeros((1, 2)), [[0, 1], [0, 1]]):
        env.reset(seed=1)
        refuses(lambda: env.step(wrong), "action=", "expected two numbers in [-1, 1], steer and pedals")
    for number in (-1, 25, 2.5, "a", None):
        refuses(lambda: env.reset(options={"episode": number}), f"episode={number!r}", "0 to 24")
    env.close()
    several = reprise.zoo.navigation(agents=1, task="straight")
    refuses(lambda: several.reset(options={"episodes": [25]}), "names 25", "0 to 24")
    several.close()


def an_action_that_cannot_be_moves_nobody_of_a_vector():
    envs = gymnasium.make_vec(NAME, num_envs=2, task="straight")
    envs.reset(seed=5)
    gas = np.array([[0, 0.6], [0, 0.6]], np.float32)
    for wrong in (np.array([[0, 1], [0, np.nan]], np.float32), gas[:1]):
        try:
            envs.step(wrong)
        except ValueError:
            continue
        raise AssertionError(wrong)
    seen, *_ = envs.step(gas)  # the first one is not asked for a step that it has made already
    envs.step(gas)
    envs.close()
    assert seen.shape == (2, 22)


def pictures_are_equal_for_equal_actions():
    seen = []
    for _ in range(2):
        env = gymnasium.make(NAME, task="straight", obs="rgb84")
        frames, _, _ = episode(env, 11, 10)
        env.close()
        seen.append(frames)
    assert seen[0].shape == (11, 84, 84, 3) and seen[0].dtype == np.uint8
    assert np.array_equal(*seen) and 20 < seen[0].mean() < 235 and not np.array_equal(seen[0][0], seen[0][-1])


def what_it_sees_is_rendered():
    env = gymnasium.make(NAME, task="straight", obs="rgb84", render_mode="rgb_array")
    seen, _ = env.reset(seed=1)
    assert np.array_equal(env.render(), seen)
    seen, *_ = env.step(np.array([0, 1], np.float32))
    assert np.array_equal(env.render(), seen)
    env.close()


def keep_the_lane(seen):
    """An action that drives along the lane at about 8 m/s, from a 'state'."""
    speed, left, sine = seen[0], seen[6], seen[7]
    return np.array([np.clip(-0.15 * left - 1.5 * sine, -1, 1), 0.5 if speed < 8 else 0.0], np.float32)


def pettingzoos_checkers():
    for obs, every in (("state", 1), ("rgb84", 3)):
        env = reprise.zoo.navigation(agents=2, task="straight", cars=10, obs=obs, every=every)
        with contextlib.redirect_stdout(io.StringIO()):
            parallel_api_test(env, num_cycles=200 if obs == "state" else 20)
        env.close()
    parallel_seed_test(lambda: reprise.zoo.navigation(agents=2, task="one_turn", cars=20), num_cycles=50)


def one_of_several_is_what_one_alone_is():
    alone = gymnasium.make(NAME, task="straight")
    several = reprise.zoo.navigation(agents=1, task="straight")
    seen, _ = alone.reset(seed=1, options={"episode": 2})
    seen_there, _ = several.reset(seed=1, options={"episodes": [2]})
    total, total_there, over, there = 0.0, 0.0, False, {"car_0": seen_there["car_0"]}
    while not over:
        assert np.array_equal(seen, there["car_0"])
        action = keep_the_lane(seen)
        seen, reward, over, truncated, info = alone.step(action)
        there, rewards, *_ = several.step({"car_0": action})
        total, total_there = total + reward, total_there + rewards["car_0"]
        assert not truncated
    while several.agents:  # it is shown the tick in which it arrives, alone nobody is
        _, rewards, terminations, _, infos = several.step({"car_0": keep_the_lane(there["car_0"])})
        total_there += rewards["car_0"]
        assert terminations["car_0"] == (not several.agents) == infos["car_0"].get("success", False)
    alone.close()
    several.close()
    assert info["success"] and total > 50 and abs(total - total_there) < 0.1, (info, total, total_there)


def several_arrive_leave_and_their_trace_verifies():
    with tempfile.TemporaryDirectory() as folder:
        env = reprise.zoo.navigation(agents=3, task="straight", folder=folder)
        seen, infos = env.reset(seed=4, options={"trace": "a.mcap"})
        gone, success = {}, {}
        while env.agents:
            # The last one waits until its time is over.
            actions = {agent: np.array([0, -1], np.float32) if agent == "car_2" else keep_the_lane(seen[agent]) for agent in env.agents}
            seen, _, terminations, truncations, infos = env.step(actions)
            for agent in set(seen) - set(env.agents):
                gone[agent], success[agent] = (terminations[agent], truncations[agent]), infos[agent]["success"]
        env.close()
        assert gone == {"car_0": (True, False), "car_1": (True, False), "car_2": (False, True)}, gone
        assert success == {"car_0": True, "car_1": True, "car_2": False}, success
        subprocess.run([find_program(), "verify", "a.mcap"], cwd=folder, check=True, capture_output=True)
        trace = reprise.Trace(pathlib.Path(folder) / "a.mcap")
        assert trace.outcome["verdict"] == "failed", trace.outcome
        assert trace.table()["id"].max() == 3 and len(trace[trace.last].tick.vehicles) == 0


def stable_baselines3():
    try:
        import torch
        from stable_baselines3 import PPO
        from stable_baselines3.common.env_checker import check_env as check
        from stable_baselines3.common.monitor import Monitor
    except ImportError:
        return "SKIPPED: stable-baselines3 is not installed: ./dev gym stable-baselines3"
    torch.set_num_threads(1)  # so small a network only loses by more
    for obs in ("state", "rgb84"):
        env = gymnasium.make(NAME, task="straight", obs=obs)
        check(env.unwrapped)
        env.close()
    env = Monitor(gymnasium.make(NAME, task="straight"))
    learner = PPO("MlpPolicy", env, n_steps=500, batch_size=100, seed=1, device="cpu")
    before = mean_reward(env, learner)
    begin = time.monotonic()
    learner.learn(2000)
    rate = 2000 / (time.monotonic() - begin)
    print(f"       2,000 steps of PPO: {rate:.0f} steps/s; mean reward of 400 steps {before:.1f} before, "
          f"{mean_reward(env, learner):.1f} after")  # fmt: skip
    env.close()


def mean_reward(env, learner):
    """Of the first 400 steps of three episodes."""
    total = 0.0
    for number in range(3):
        seen, _ = env.reset(seed=100 + number, options={"episode": number})
        for _ in range(400):
            seen, reward, terminated, truncated, _ = env.unwrapped.step(learner.predict(seen, deterministic=True)[0])
            assert np.isfinite(seen).all()
            total += reward / 3
            if terminated or truncated:
                break
    return total


if __name__ == "__main__":
    for check in (
        gymnasiums_checker,
        same_seed_and_actions_give_equal_observations,
        the_reward_is_the_way_that_was_gained,
        standing_still_is_truncated_when_the_time_is_over,
        an_action_holds_for_as_many_ticks_as_was_said,
        two_at_once,
        a_vector_is_what_gymnasiums_own_is,
        what_cannot_be_is_told,
        an_action_that_cannot_be_moves_nobody_of_a_vector,
        pictures_are_equal_for_equal_actions,
        what_it_sees_is_rendered,
        pettingzoos_checkers,
        one_of_several_is_what_one_alone_is,
        several_arrive_leave_and_their_trace_verifies,
        stable_baselines3,
    ):
        skipped = check()
        print(f"{skipped or 'ok':<6}", check.__name__.replace("_", " "), flush=True)
