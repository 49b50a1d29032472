"""How the fitted numbers that come with the package were made, and from what.

| run | writes, in `kille/perception` | fitted to, in the data folder |
| --- | --- | --- |
| `codebook` | `cues/codebooks.npz` | `ycbv_scenes`, `mosd_scenes`, `ycb_meshes` |
| `colour_words` | `colours/xkcd.json` | `colour_names_xkcd` |
| `evidence` | `weighing.json` | `ycb_meshes`, `sota_kinect`, the simulated ten |
| `merge` | `surfaces/merge.npz` | rendered heaps (`piles`), `ycb_meshes` in them |

`python -m tools.fitting.merge DATA`, from the project's root.
"""
