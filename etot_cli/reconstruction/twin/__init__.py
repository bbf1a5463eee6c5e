"""The scene and its files: physics, YAML, meshes, MJCF, overlay."""
