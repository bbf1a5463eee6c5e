"""Reading what a model wrote: JSON where there is some, prose where there is not."""
