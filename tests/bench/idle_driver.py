"""The least that a driver in Python can do: it looks at its speed, and answers."""
import reprise

reprise.drive(lambda seen: reprise.Control(throttle=0.4 if seen.ego.speed < 5 else 0.0))
