"""The synthetic Kinect: a table with textured things, seen from a posed camera."""

from kille.sensors.synthetic.sensor import Synthetic, open_synthetic

__all__ = ["Synthetic", "open_synthetic"]
