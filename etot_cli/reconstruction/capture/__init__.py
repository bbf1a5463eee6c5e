"""A capture: its files, the camera, and whether depth, colour and desk agree."""
