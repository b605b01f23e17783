// Declarations of ssphh/runtime/runtime.h for C#, which load libssphh_runtime.so (target ssphh::runtime_shared), and a light
// over them. Sizes are those of 64-bit systems.

using System;
using System.Runtime.InteropServices;

namespace Ssphh
{
    public enum RuntimeResult
    {
        Ok, BadArgument, BadMemory, NotCooked, BadVersion, CutOff, Damaged, Invalid, OtherGeometry, OtherGroups
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct RuntimePlace
    {
        public float PositionX, PositionY, PositionZ, NormalX, NormalY, NormalZ;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct RuntimeInfo
    {
        public uint Groups, Probes, Points, HasSight;
        public float Time;
        public ulong Geometry, SceneHigh, SceneLow, LightBytes;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct RuntimeGroup
    {
        public IntPtr Name;  // UTF-8
        public float ScaleR, ScaleG, ScaleB;
        public uint Baked;
    }

    public static class Runtime
    {
        const string Library = "ssphh_runtime";
        public const uint Still = 0, Open = 1;

        [DllImport(Library)] public static extern IntPtr ssphh_runtime_message(RuntimeResult result);
        [DllImport(Library)] public static extern RuntimeResult ssphh_runtime_size_needed(IntPtr file, UIntPtr fileSize, out UIntPtr memorySize);
        [DllImport(Library)] public static extern RuntimeResult ssphh_runtime_open(IntPtr file, UIntPtr fileSize, IntPtr memory, UIntPtr memorySize, out IntPtr runtime);
        [DllImport(Library)] public static extern RuntimeResult ssphh_runtime_describe(IntPtr runtime, out RuntimeInfo info);
        [DllImport(Library)] public static extern RuntimeResult ssphh_runtime_describe_group(IntPtr runtime, uint group, out RuntimeGroup description);
        [DllImport(Library)] public static extern RuntimeResult ssphh_runtime_set_group_scale(IntPtr runtime, uint group, float[] scale);
        [DllImport(Library)] public static extern RuntimeResult ssphh_runtime_swap_light(IntPtr runtime, IntPtr file, UIntPtr fileSize);
        [DllImport(Library)] public static extern RuntimeResult ssphh_runtime_irradiance(IntPtr runtime, uint flags, float[] position, float[] normal, float[] rgb);
        [DllImport(Library)] public static extern RuntimeResult ssphh_runtime_irradiance_batch(IntPtr runtime, uint flags, RuntimePlace[] places, UIntPtr count, float[] rgb);
    }

    /// A cooked file, read into memory of its own.
    public sealed class Light : IDisposable
    {
        IntPtr block, runtime;

        public Light(byte[] file)
        {
            UIntPtr size = (UIntPtr)(ulong)file.Length, needed;
            int aligned = (file.Length + 15) / 16 * 16;
            block = Marshal.AllocHGlobal(aligned + 32768);  // the file, and more than any file's memory
            IntPtr begin = (IntPtr)((block.ToInt64() + 15) / 16 * 16);
            Marshal.Copy(file, 0, begin, file.Length);
            Check(Runtime.ssphh_runtime_size_needed(begin, size, out needed));
            Check(Runtime.ssphh_runtime_open(begin, size, begin + aligned, needed, out runtime));
        }

        public void SetGroupScale(uint group, float r, float g, float b)
        {
            Check(Runtime.ssphh_runtime_set_group_scale(runtime, group, new[] { r, g, b }));
        }

        public void Irradiance(uint flags, RuntimePlace[] places, float[] rgb)
        {
            if (rgb.Length < 3 * places.Length) throw new ArgumentException("three numbers for each place");
            Check(Runtime.ssphh_runtime_irradiance_batch(runtime, flags, places, (UIntPtr)(ulong)places.Length, rgb));
        }

        public void Dispose()
        {
            Marshal.FreeHGlobal(block);
            block = runtime = IntPtr.Zero;
        }

        static void Check(RuntimeResult result)
        {
            if (result != RuntimeResult.Ok)
                throw new InvalidOperationException(Marshal.PtrToStringAnsi(Runtime.ssphh_runtime_message(result)));
        }
    }
}
