"""What made the things that the simulated Kinect shows: their meshes and pictures.

`python -m tools.modelling.toys`, from the project's root, writes them into
`kille/sensors/synthetic`: in `toys` the ten objects of the paper, each an OBJ mesh with
its material and its picture, and the wood of the table.
"""
