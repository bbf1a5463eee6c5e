"""Shapes and poses from outside: files, object libraries, servers."""
