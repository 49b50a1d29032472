"""Sources of frames: the simulated Kinect and recordings, behind one protocol."""
