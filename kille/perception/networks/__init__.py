"""Pretrained networks: weights that PyTorch wrote, run by OpenCV."""
