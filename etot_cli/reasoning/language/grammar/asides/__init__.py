"""What stands beside a request and asks for nothing: reasons, remarks, how things are."""
