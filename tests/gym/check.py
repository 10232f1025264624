#!/usr/bin/env python3
"""Holds the environments of reprise.gym against Gymnasium's own checker, and against what they promise: check.py

With Stable-Baselines3 installed also against its checker, and 2,000 steps of PPO. Called by `./dev gym`.
"""
import warnings

import gymnasium
import numpy as np
from gymnasium.utils.env_checker import check_env

import reprise.gym

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


def two_at_once():
    envs = gymnasium.make_vec(NAME, num_envs=2, vectorization_mode="async", task="one_turn")
    seen, _ = envs.reset(seed=5)
    for _ in range(20):
        seen, *_ = envs.step(np.tile(np.array([0, 0.5], np.float32), (2, 1)))
    envs.close()
    assert seen.shape == (2, 22) and not np.array_equal(seen[0], seen[1])


def pictures_are_equal_for_equal_actions():
    seen = []
    for _ in range(2):
        env = gymnasium.make(NAME, task="straight", obs="rgb84")
        frames, _, _ = episode(env, 11, 10)
        env.close()
        seen.append(frames)
    assert seen[0].shape == (11, 84, 84, 3) and seen[0].dtype == np.uint8
    assert np.array_equal(*seen) and 20 < seen[0].mean() < 235 and not np.array_equal(seen[0][0], seen[0][-1])


def stable_baselines3():
    try:
        from stable_baselines3 import PPO
        from stable_baselines3.common.env_checker import check_env as check
    except ImportError:
        return "SKIPPED: stable-baselines3 is not installed"
    env = gymnasium.make(NAME, task="straight")
    check(env.unwrapped)
    PPO("MlpPolicy", env, n_steps=500, seed=1, device="cpu").learn(2000)
    env.close()


if __name__ == "__main__":
    for check in (
        gymnasiums_checker,
        same_seed_and_actions_give_equal_observations,
        the_reward_is_the_way_that_was_gained,
        standing_still_is_truncated_when_the_time_is_over,
        two_at_once,
        pictures_are_equal_for_equal_actions,
        stable_baselines3,
    ):
        skipped = check()
        print(f"{skipped or 'ok':<6}", check.__name__.replace("_", " "), flush=True)
