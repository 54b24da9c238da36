"""What a message between two processes of this machine costs, for docs/scaling.md.

Usage: python3 tools/message_cost.py [--rounds N]

Two processes send a message to and fro over a TCP socket of the loopback device. Half of the median round trip is what
a message takes; Python's share of it is some 10 us, so it is no less than a library of messages would take here.
"""

import argparse
import os
import socket
import statistics
import time

SIZES = (64, 4096, 65536, 1 << 20)  # [bytes]


def receive(connection, size):
    left = size
    while left > 0:
        left -= len(connection.recv(left))


def answer(address, rounds):
    connection = socket.create_connection(address)
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    for size in SIZES:
        for _ in range(rounds):
            receive(connection, size)
            connection.sendall(bytes(size))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=1000)
    rounds = parser.parse_args().rounds
    server = socket.create_server(("127.0.0.1", 0))
    if os.fork() == 0:
        answer(server.getsockname(), rounds)
        os._exit(0)
    connection, _ = server.accept()
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    print("| bytes | a message, us | MB/s |\n|---|---|---|")
    for size in SIZES:
        taken = []
        for _ in range(rounds):
            start = time.perf_counter()
            connection.sendall(bytes(size))
            receive(connection, size)
            taken.append((time.perf_counter() - start) / 2)
        median = statistics.median(taken)
        print(f"| {size} | {1e6 * median:.1f} | {size / median / 1e6:.0f} |")
    os.wait()


main()
