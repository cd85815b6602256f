"""The trocars of a view; a view of a scene without any imports none of it."""
