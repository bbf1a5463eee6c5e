"""The methods that are compared: all share everything but the planning idea."""
