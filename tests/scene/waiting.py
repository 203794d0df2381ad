# SPDX-License-Identifier: GPL-2.0-or-later
"""A script for YADE that waits for other scripts: each becomes a process of its own, a copy of this one as it was after the start, and ends as YADE does."""


def nextScript():
	"""Returns in the copies only, each with its own script, settings, folder and streams."""
	import gc, json, os, socket, sys
	import matplotlib.pyplot  # takes longer to import than most scripts to run
	gc.collect()
	gc.freeze()  # objects that all processes share: each would copy its pages only to look for garbage there when it ends
	connection = socket.socket(fileno=int(sys.argv[1]))
	while True:
		message, streams, _, _ = socket.recv_fds(connection, 1 << 20, 2)
		if not message: os._exit(0)  # the tests have ended
		copy = os.fork()
		if not copy: break
		for stream in streams:
			os.close(stream)
		connection.send(json.dumps(copy).encode())
		connection.send(json.dumps(os.waitstatus_to_exitcode(os.waitpid(copy, 0)[1])).encode())
	connection.close()
	for own, stream in zip((1, 2), streams):
		os.dup2(stream, own)
		os.close(stream)
	arguments, folder, environment = json.loads(message)
	os.chdir(folder)
	os.environ.update(environment)
	if '/examples/' in arguments[0]:
		import labels
		labels.watch()
	sys.argv[:] = arguments
	with open(arguments[0]) as file:
		return compile(file.read(), arguments[0], 'exec')


exec(nextScript())
