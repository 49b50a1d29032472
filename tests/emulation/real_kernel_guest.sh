#!/bin/sh
# Runs inside the virtual machine of real_kernel.py, as root of a copy of this computer.
# Arguments: the Python to use, the folders of the emulator and of the kernel, and how
# fast the Kinect's clock goes.
python=$1 emulation=$2 kernel=$3 speed=$4
export PATH=/usr/sbin:/usr/bin:/sbin:/bin PYTHONPATH=$emulation PYTHONDONTWRITEBYTECODE=1
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 HOME=/root
work=/run/kinect
mkdir -p $work && cd $work || exit 1
say() { echo "[$(cut -d' ' -f1 /proc/uptime) s] $*"; }
count() { grep -c "$1" "$2"; }

say "kernel $(uname -r), the Kinect's clock at $speed of its speed"
busybox ip link set lo up
# Without it libusb does not hear of what is plugged in later.
/lib/systemd/systemd-udevd --daemon
modprobe -d "$kernel" vhci-hcd
"$python" -m kinect_emulator.usbip --speed "$speed" &
emulator=$!
until grep -q ':0CA8 ' /proc/net/tcp; do sleep 0.2; done # port 3240
for place in 1-1.1 1-1.3; do
    until usbip attach -r 127.0.0.1 -b $place; do sleep 0.5; done
done
until grep -qs 02ae /sys/bus/usb/devices/*/idProduct; do sleep 0.2; done
sleep 1
say "the kernel sees: $(cat /sys/bus/usb/devices/*/product | grep Xbox | tr '\n' ',')"

timeout -s INT 10 stdbuf -oL freenect-camtest >camtest.txt 2>camtest.err
say "freenect-camtest: $(count 'Received depth' camtest.txt) depth and" \
    "$(count 'Received video' camtest.txt) colour frames in 10 s," \
    "$(grep -cE 'Lost|Inconsistent|Invalid' camtest.err) complaints"

timeout -s INT 8 stdbuf -oL freenect-tiltdemo >tiltdemo.txt 2>&1
say "freenect-tiltdemo: $(count 'led\[' tiltdemo.txt) moves"

"$python" "$emulation/real_kernel_driver.py"
kill $emulator
say "done"
