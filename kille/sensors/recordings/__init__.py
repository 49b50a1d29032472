"""Recordings: what was seen elsewhere or earlier, played as a sensor, and written.

`format_detection` tells the format of a path by its content; each format has a module
that reads it and, where it is written, one that writes it.
"""

from kille.sensors.recordings.format_detection import open_recording
from kille.sensors.recordings.galleries import Gallery
from kille.sensors.recordings.playback import Recording, RecordingOverError
from ttr.aliases import former_names

__getattr__ = former_names(__name__, {"RecordingOver": "RecordingOverError"})

__all__ = ["Gallery", "Recording", "RecordingOverError", "open_recording"]
