"""What has been spoken of so far, and what is where by then."""
